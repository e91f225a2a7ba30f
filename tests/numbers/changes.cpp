// SPDX-License-Identifier: MIT
#include "tests/numbers/changes.h"

namespace carom::test {
namespace {

using nlohmann::json;

constexpr std::size_t kItems = 6;

void collect(const json& value, const json::json_pointer& place, std::vector<json::json_pointer>& out) {
  if (value.is_number()) out.push_back(place);
  if (value.is_object())
    for (const auto& [name, member] : value.items()) collect(member, place / name, out);
  if (!value.is_array()) return;
  const bool objects = !value.empty() && value.front().is_object();
  for (std::size_t i = 0; i < value.size() && !(objects && i >= kItems); ++i) collect(value[i], place / i, out);
}

}  // namespace

const std::vector<std::string>& strangeValues() {
  static const std::vector<std::string> values{
      "0",     "-0.0",   "5e-324", "1e-310", "1e-300", "1e-160", "1e-30", "1e-9", "-1",       "1e9",
      "-1e9",  "1e30",   "-1e30",  "1e160",  "1e300",  "1e400",  "NaN",   "-Infinity", "\"text\"", "null"};
  return values;
}

std::vector<json::json_pointer> numbersOf(const json& document) {
  std::vector<json::json_pointer> out;
  collect(document, json::json_pointer(), out);
  return out;
}

std::string changed(const json& document, const json::json_pointer& place, const std::string& text) {
  const std::string mark = "the place of the change";
  json copy = document;
  copy[place] = mark;
  std::string out = copy.dump();
  return out.replace(out.find("\"" + mark + "\""), mark.size() + 2, text);
}

}  // namespace carom::test
