// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/svg/canvas.hpp"

namespace carom::formats_detail {

/// A panel cut into square cells, with a sum in each.
class CellGrid {
 public:
  CellGrid(const PixelBox& panel, double cell);
  /// Outside the panel nothing is added.
  void add(const Vec2& pixel, double amount);
  double largest() const;

  /// Path data of a dot in the middle of each cell whose sum is above `low` and not above `high`.
  std::string dots(double low, double high) const;
  /// Path data of the same cells as lines, to be stroked as wide as a cell.
  std::string rows(double low, double high) const;
  double cell() const { return cell_; }

 private:
  bool within(int column, int row, double low, double high) const;
  PixelBox panel_;
  double cell_;
  int columns_, rows_;
  std::vector<double> sums_;
};

/// Upper ends of at most five classes for counts from 1 to `most`, each about as many times the last one.
std::vector<int> countClasses(int most);

}  // namespace carom::formats_detail
