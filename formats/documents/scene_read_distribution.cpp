// SPDX-License-Identifier: MIT
#include "formats/documents/scene_reader.hpp"
#include "formats/json/json.hpp"

namespace carom::formats_detail {
namespace {

/// One number for all components, or one each; empty where there is no such member.
std::vector<double> readEach(const Json& value, const char* member, std::size_t count, const std::string& where) {
  const auto found = value.find(member);
  if (found == value.end()) return {};
  if (found->is_number()) return {found->get<double>()};
  if (found->size() != count)
    fail(pointerTo(where, member), describe(*found),
         "a number, or an array of " + std::to_string(count) + ", one for each component that varies");
  return found->get<std::vector<double>>();
}

std::vector<std::vector<double>> readFactor(const Json& value, std::size_t count, const std::string& where) {
  const auto found = value.find("factor");
  if (found == value.end()) return {};
  const std::string place = where + "/factor";
  if (found->size() != count)
    fail(place, describe(*found), "an array of " + std::to_string(count) + " rows, one for each component that varies");
  for (std::size_t i = 0; i < count; ++i)
    if ((*found)[i].size() != (*found)[0].size())
      fail(pointerTo(place, i), describe((*found)[i]),
           "a row of " + std::to_string((*found)[0].size()) + " numbers, like the first");
  return found->get<std::vector<std::vector<double>>>();
}

void requireOneSpread(const Json& value, const std::string& where) {
  if (value.contains("deviation") == value.contains("factor"))
    fail(where, describe(value), "either \"deviation\" or \"factor\"");
}

}  // namespace

Distribution readDistribution(const Json& value, std::size_t count, const std::string& where) {
  const std::string kind = value.begin().key();
  const Json& inside = value.begin().value();
  const std::string place = pointerTo(where, kind);
  if (kind == "uniform_on_so3") return UniformOrientation{};
  if (kind == "uniform")
    return UniformDistribution{readEach(inside, "from", count, place), readEach(inside, "to", count, place)};
  requireOneSpread(inside, place);
  const std::vector<double> deviation = readEach(inside, "deviation", count, place);
  const std::vector<std::vector<double>> factor = readFactor(inside, count, place);
  if (kind == "normal") return NormalDistribution{readEach(inside, "mean", count, place), deviation, factor};
  return LogNormalDistribution{readEach(inside, "median", count, place), deviation, factor};
}

}  // namespace carom::formats_detail
