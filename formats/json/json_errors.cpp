// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "adjoint/base/errors.h"
#include "formats/base/nearest_word.hpp"
#include "formats/json/json.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

constexpr std::size_t kLongestExcerpt = 60;

/// At most `most` bytes, not cut inside a character, with "..." for what is left out.
std::string cut(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;
  return std::string(text.substr(0, end)) + "...";
}

std::string shortened(std::string_view text) { return quotedText(cut(text, kLongestExcerpt)); }

}  // namespace

std::string pointerTo(const std::string& parent, std::string_view member) {
  constexpr std::size_t kLongestMember = 400;  // most names are whole
  std::string pointer = parent + "/";
  for (const char c : cut(member, kLongestMember)) {
    if (c == '~') {
      pointer += "~0";
    } else if (c == '/') {
      pointer += "~1";
    } else if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) {
      const std::string quoted = quotedText({&c, 1});  // "\n": a message stays on its line
      pointer += quoted.substr(1, quoted.size() - 2);
    } else {
      pointer += c;
    }
  }
  return pointer;
}

std::string pointerTo(const std::string& parent, std::size_t index) { return parent + "/" + std::to_string(index); }

std::string describe(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
    case Json::value_t::boolean:
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return compactText(value);
    case Json::value_t::number_float:
      return numberText(value.get<double>());
    case Json::value_t::string:
      return shortened(value.get_ref<const std::string&>());
    case Json::value_t::array: {
      const bool flat = std::none_of(value.begin(), value.end(), [](const Json& v) { return v.is_structured(); });
      if (value.empty()) return "an empty array";
      if (!flat || value.size() > 6) return "an array of " + std::to_string(value.size());
      std::string text;
      for (const Json& item : value) text += (text.empty() ? "[" : ", ") + describe(item);
      return text + "]";
    }
    case Json::value_t::object: {
      if (value.empty()) return "an empty object";
      std::string text = "an object with ";
      std::size_t count = 0;
      for (const auto& member : value.items()) {
        if (++count > 4) return text + ", ...";
        text += (count > 1 ? ", " : "") + shortened(member.key());
      }
      return text;
    }
    default:
      return "an unknown value";
  }
}

std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
  return text;
}

std::string hintFor(std::string_view word, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = nearestWord(word, known);
  return nearest ? "; did you mean " + shortened(*nearest) + "?" : "";
}

std::string expectedOf(std::string_view word, const std::vector<std::string>& known) {
  return listed(known) + hintFor(word, known);
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t kMost = 30;
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < kMost; ++i) text += (i > 0 ? ", " : "") + shortened(words[i]);
  return words.empty() ? "none" : words.size() > kMost ? text + ", ..." : text;
}

void fail(const std::string& where, const std::string& found, const std::string& expected) {
  throw InputError(where, "found " + found + ", expected " + expected);
}

}  // namespace carom::formats_detail
