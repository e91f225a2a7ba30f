// SPDX-License-Identifier: MIT
#include "ode_bridge/box_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::ode_bridge_detail {
namespace {

constexpr int kMostCells = 1024;  // along an axis
constexpr float kInfinite = std::numeric_limits<float>::infinity();

bool fits(const Bounds& b, double half) { return (b.high - b.low).maxCoeff() <= 2 * half; }

}  // namespace

void BoxGrid::rebuild(const std::vector<Bounds>& boxes, double half) {
  half_ = half;
  // the cells cover all but the outermost fiftieth of the middles; what lies outside belongs to the cells at the border
  Vec3 extent = Vec3::Zero();
  std::vector<double> middles;
  for (int k = 0; k < 3; ++k) {
    middles.clear();
    for (const Bounds& b : boxes)
      if (fits(b, half)) middles.push_back(0.5 * (b.low[k] + b.high[k]));
    if (middles.empty()) break;
    const auto tail = static_cast<std::ptrdiff_t>(middles.size() / 50);
    std::nth_element(middles.begin(), middles.begin() + tail, middles.end());
    corner_[k] = middles[static_cast<std::size_t>(tail)];
    std::nth_element(middles.begin(), middles.end() - 1 - tail, middles.end());
    extent[k] = std::max(0.0, middles[middles.size() - 1 - static_cast<std::size_t>(tail)] - corner_[k]);
  }
  const double most = 4.0 * static_cast<double>(boxes.size()) + 64;
  for (cell_size_ = 2 * half;; cell_size_ *= 1.25) {
    double count = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      cells_[k] = static_cast<int>(
          std::min<double>(kMostCells, std::floor(extent[static_cast<Eigen::Index>(k)] / cell_size_) + 1));
      count *= cells_[k];
    }
    if (count <= most) break;
  }
  places_.assign(kDepth * static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) *
                     static_cast<std::size_t>(cells_[2]),
                 {});
  cell_.assign(boxes.size(), -1);
  large_.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) insert(static_cast<int>(i), cellOf(boxes[i]), boxes[i]);
}

BoxGrid::Cell BoxGrid::cellAt(const Vec3& p) const {
  Cell c;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double at = (p[k] - corner_[k]) / cell_size_;
    c[i] = at > 0 ? static_cast<int>(std::min<double>(at, cells_[i] - 1)) : 0;
  }
  return c;
}

int BoxGrid::cellOf(const Bounds& box) const {
  if (!fits(box, half_)) return -1;
  const Cell c = cellAt(0.5 * (box.low + box.high));
  return (c[2] * cells_[1] + c[1]) * cells_[0] + c[0];
}

BoxGrid::Filed BoxGrid::filed(int body, const Bounds& box) {
  Filed f;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    f.low[k] = std::nextafter(static_cast<float>(box.low[i]), -kInfinite);
    f.high[k] = std::nextafter(static_cast<float>(box.high[i]), kInfinite);
  }
  f.body = body;
  return f;
}

void BoxGrid::insert(int body, int cell, const Bounds& box) {
  int& mine = cell_[static_cast<std::size_t>(body)] = -1;
  if (cell >= 0) {
    Filed* places = placesOf(cell);
    Filed* end = places + kDepth;
    Filed* free = std::find_if(places, end, [](const Filed& f) { return f.body < 0; });
    if (free != end) {
      *free = filed(body, box);
      mine = cell;
      return;
    }
  }
  large_.push_back(body);
}

void BoxGrid::remove(int body) {
  const int cell = cell_[static_cast<std::size_t>(body)];
  if (cell < 0) {
    large_.erase(std::find(large_.begin(), large_.end(), body));
    return;
  }
  Filed* places = placesOf(cell);
  Filed* mine = std::find_if(places, places + kDepth, [&](const Filed& f) { return f.body == body; });
  Filed* last = std::find_if(mine, places + kDepth, [](const Filed& f) { return f.body < 0; }) - 1;
  *mine = *last;
  *last = {};
}

void BoxGrid::move(int body, const std::vector<Bounds>& boxes) {
  const Bounds& box = boxes[static_cast<std::size_t>(body)];
  const int cell = cellOf(box);
  if (cell >= 0 && cell == cell_[static_cast<std::size_t>(body)]) {
    Filed* places = placesOf(cell);
    *std::find_if(places, places + kDepth, [&](const Filed& f) { return f.body == body; }) = filed(body, box);
    return;
  }
  remove(body);
  insert(body, cell, box);
}

void BoxGrid::find(int body, const std::vector<Bounds>& boxes, std::vector<int>& out) const {
  const Bounds& box = boxes[static_cast<std::size_t>(body)];
  const double margin = half_ * (1 + 1e-9);
  for (int other : large_)
    if (other != body && meet(box, boxes[static_cast<std::size_t>(other)])) out.push_back(other);
  const Filed mine = filed(body, box);
  const auto mayMeet = [&](const Filed& f) {
    return mine.low[0] <= f.high[0] && f.low[0] <= mine.high[0] && mine.low[1] <= f.high[1] &&
           f.low[1] <= mine.high[1] && mine.low[2] <= f.high[2] && f.low[2] <= mine.high[2];
  };
  const Cell low = cellAt(box.low.array() - margin), high = cellAt(box.high.array() + margin);
  // each row of cells lies together, the rows all over the memory: they are fetched side by side
  const auto forEachRow = [&](const auto& f) {
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y) {
        const auto row = static_cast<std::size_t>((z * cells_[1] + y) * cells_[0]);
        f(row + static_cast<std::size_t>(low[0]), row + static_cast<std::size_t>(high[0]) + 1);
      }
  };
  forEachRow([&](std::size_t cell, std::size_t end) {
    for (; cell < end; ++cell) __builtin_prefetch(&places_[kDepth * cell]);
  });
  forEachRow([&](std::size_t cell, std::size_t end) {
    for (; cell < end; ++cell)
      for (std::size_t i = kDepth * cell; i < kDepth * (cell + 1) && places_[i].body >= 0; ++i)
        if (mayMeet(places_[i]) && places_[i].body != body) out.push_back(places_[i].body);
  });
}

}  // namespace carom::ode_bridge_detail
