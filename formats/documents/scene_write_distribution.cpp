// SPDX-License-Identifier: MIT
#include "formats/documents/scene_writer.hpp"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {
namespace {

void writeEach(JsonWriter& out, const char* member, const std::vector<double>& numbers) {
  if (numbers.size() == 1)
    out.members(member, numbers[0]);
  else
    out.unlessEmpty(member, numbers);
}

void writeFactor(JsonWriter& out, const std::vector<std::vector<double>>& factor) {
  if (factor.empty()) return;
  out.key("factor").beginArray(JsonWriter::Layout::line);
  for (const std::vector<double>& row : factor) out.value(row);
  out.endArray();
}

void requireAllFinite(const std::vector<double>& numbers, const std::string& where) {
  for (const double number : numbers) requireFinite(where, number);
}

}  // namespace

void requireWritable(const Distribution& distribution, const std::string& where) {
  const auto each = [&](const auto& centre, const auto& deviation, const auto& factor) {
    requireAllFinite(centre, where), requireAllFinite(deviation, where);
    for (const std::vector<double>& row : factor) requireAllFinite(row, where);
  };
  if (const auto* normal = std::get_if<NormalDistribution>(&distribution))
    each(normal->mean, normal->deviation, normal->factor);
  if (const auto* normal = std::get_if<LogNormalDistribution>(&distribution))
    each(normal->median, normal->deviation, normal->factor);
  if (const auto* uniform = std::get_if<UniformDistribution>(&distribution))
    each(uniform->from, uniform->to, std::vector<std::vector<double>>{});
}

void writeDistribution(JsonWriter& out, const Distribution& distribution) {
  out.key("distribution").beginObject(JsonWriter::Layout::line);
  if (const auto* normal = std::get_if<NormalDistribution>(&distribution)) {
    out.key("normal").beginObject(JsonWriter::Layout::line);
    writeEach(out, "mean", normal->mean), writeEach(out, "deviation", normal->deviation),
        writeFactor(out, normal->factor);
    out.endObject();
  } else if (const auto* log_normal = std::get_if<LogNormalDistribution>(&distribution)) {
    out.key("log_normal").beginObject(JsonWriter::Layout::line);
    writeEach(out, "median", log_normal->median), writeEach(out, "deviation", log_normal->deviation),
        writeFactor(out, log_normal->factor);
    out.endObject();
  } else if (const auto* uniform = std::get_if<UniformDistribution>(&distribution)) {
    out.key("uniform").beginObject(JsonWriter::Layout::line);
    writeEach(out, "from", uniform->from), writeEach(out, "to", uniform->to);
    out.endObject();
  } else {
    out.members("uniform_on_so3", true);
  }
  out.endObject();
}

}  // namespace carom::formats_detail
