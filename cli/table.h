// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace carom::cli {

class Output;

/// Rows of text in aligned columns, whatever the script of the names in them. Columns whose heading starts with '>'
/// stand to the right, without that sign. Headings name the unit, in brackets.
class Table {
 public:
  explicit Table(std::vector<std::string> headings);
  void row(std::vector<std::string> cells);
  bool empty() const { return rows_.size() == 1; }
  std::string text(bool colours) const;
  void print(Output& out) const;

 private:
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;  // the headings first
};

}  // namespace carom::cli
