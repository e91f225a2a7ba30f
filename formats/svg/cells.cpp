// SPDX-License-Identifier: MIT
#include "formats/svg/cells.hpp"

#include <algorithm>
#include <cmath>

#include "formats/svg/path.hpp"

namespace carom::formats_detail {

CellGrid::CellGrid(const PixelBox& panel, double cell)
    : panel_(panel),
      cell_(cell),
      columns_(static_cast<int>(std::ceil(panel.width / cell))),
      rows_(static_cast<int>(std::ceil(panel.height / cell))),
      sums_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0) {}

void CellGrid::add(const Vec2& pixel, double amount) {
  if (!panel_.contains(pixel)) return;
  const int column = std::min(columns_ - 1, static_cast<int>((pixel.x() - panel_.x) / cell_));
  const int row = std::min(rows_ - 1, static_cast<int>((pixel.y() - panel_.y) / cell_));
  sums_[static_cast<std::size_t>(row * columns_ + column)] += amount;
}

double CellGrid::largest() const { return *std::max_element(sums_.begin(), sums_.end()); }

bool CellGrid::within(int column, int row, double low, double high) const {
  const double sum = sums_[static_cast<std::size_t>(row * columns_ + column)];
  return sum > low && sum <= high;
}

std::string CellGrid::dots(double low, double high) const {
  SvgPath path;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      if (within(column, row, low, high))
        path.stroke({panel_.x + (column + 0.5) * cell_, panel_.y + (row + 0.5) * cell_}, 0);
  return path.data();
}

std::string CellGrid::rows(double low, double high) const {
  SvgPath path;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      if (!within(column, row, low, high)) continue;
      const int first = column;
      while (column + 1 < columns_ && within(column + 1, row, low, high)) ++column;
      path.stroke({panel_.x + first * cell_, panel_.y + (row + 0.5) * cell_}, (column + 1 - first) * cell_);
    }
  return path.data();
}

std::vector<int> countClasses(int most) {
  constexpr int kClasses = 5;
  std::vector<int> ends;
  for (int k = 1; k <= kClasses; ++k) {
    const int end = most <= kClasses ? std::min(k, most) : static_cast<int>(std::lround(std::pow(most, k / 5.0)));
    if (ends.empty() || end > ends.back()) ends.push_back(end);
  }
  return ends;
}

}  // namespace carom::formats_detail
