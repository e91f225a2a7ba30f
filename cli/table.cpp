// SPDX-License-Identifier: MIT
#include "cli/table.h"

#include <algorithm>

#include "cli/output.h"
#include "cli/terminal.h"

namespace carom::cli {

Table::Table(std::vector<std::string> headings) {
  for (std::string& heading : headings) {
    right_.push_back(heading.starts_with('>'));
    if (right_.back()) heading.erase(0, 1);
  }
  rows_.push_back(std::move(headings));
}

void Table::row(std::vector<std::string> cells) {
  cells.resize(right_.size());
  for (std::string& cell : cells) cell = printable(cell);
  rows_.push_back(std::move(cells));
}

std::string Table::text(bool colours) const {
  std::vector<std::vector<std::size_t>> widths;  // of every cell
  std::vector<std::size_t> widest(right_.size(), 0);
  for (const auto& row : rows_) {
    auto& cells = widths.emplace_back();
    for (std::size_t c = 0; c < row.size(); ++c) {
      cells.push_back(displayWidth(row[c]));
      widest[c] = std::max(widest[c], cells.back());
    }
  }
  std::string all;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    std::string line;
    for (std::size_t c = 0; c < right_.size(); ++c) {
      const std::string padding(widest[c] - widths[r][c], ' ');
      line += "  " + (right_[c] ? padding + rows_[r][c] : rows_[r][c] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    all += (colours && r == 0 ? coloured(Look::heading, line) : line) + '\n';
  }
  return all;
}

void Table::print(Output& out) const { out.text() << text(out.colours()); }

}  // namespace carom::cli
