// SPDX-License-Identifier: MIT
#include "explore/store/table_csv.h"

#include <charconv>
#include <cmath>

namespace carom {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

template <class T>
void putField(std::string& line, T number) {
  char text[40];
  line += ',';
  line.append(text, std::to_chars(text, text + sizeof text, number).ptr);
}

void putReal(std::string& line, double number) {
  if (std::isnan(number))
    line += ',';
  else
    putField(line, number);
}

std::string headings(const Exploration& exploration, const WorldTable& table) {
  std::string line = "world,status,flags,impacts,end,signature";
  for (const std::string& box : exploration.boxes()) line += ',' + quoted("face up of '" + box + "'");
  for (const DrawnNumber& number : exploration.numbers()) line += ',' + quoted(number.name);
  for (const ExploredRow& row : exploration.rows()) line += ',' + quoted(row.name);
  if (table.has_jacobian)
    for (const ExploredRow& row : exploration.rows())
      for (const DrawnNumber& number : exploration.numbers())
        line += ',' + quoted("d " + row.name + " / d " + number.name);
  return line + '\n';
}

}  // namespace

std::string tableCsv(const Exploration& exploration, const WorldTable& table) {
  std::string text = headings(exploration, table);
  const std::size_t entries = table.has_jacobian ? table.rows * table.numbers : 0;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const std::uint8_t status = table.status[k];
    text += std::to_string(table.world[k]) + ',' + nameOfWorldStatus(status);
    putField(text, hasMotion(status) ? status & ~world_status::kMotion : 0);
    putField(text, table.impacts[k]);
    putReal(text, table.end[k]);
    putField(text, table.signature[k]);
    for (std::size_t b = 0; b < table.boxes; ++b) putField(text, static_cast<int>(table.face[k * table.boxes + b]));
    for (std::size_t j = 0; j < table.numbers; ++j) putReal(text, table.drawn[k * table.numbers + j]);
    for (std::size_t i = 0; i < table.rows; ++i) putReal(text, table.values[k * table.rows + i]);
    for (std::size_t e = 0; e < entries; ++e) putReal(text, table.jacobian[k * entries + e]);
    text += '\n';
  }
  return text;
}

}  // namespace carom
