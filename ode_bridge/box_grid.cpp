#include "ode_bridge/box_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
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
  for (cell_size_ = 1.5 * half;; cell_size_ *= 1.25) {
    double count = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      cells_[k] = static_cast<int>(
          std::min<double>(kMostCells, std::floor(extent[static_cast<Eigen::Index>(k)] / cell_size_) + 1));
      count *= cells_[k];
    }
    if (count <= most) break;
  }
  first_.assign(
      static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(cells_[2]),
      -1);
  filed_.assign(boxes.size(), {});
  before_.assign(boxes.size(), -1);
  slot_.assign(boxes.size(), -1);
  large_.clear();
  for (std::size_t i = boxes.size(); i-- > 0;) {
    file(static_cast<int>(i), boxes[i]);
    insert(static_cast<int>(i), slotOf(boxes[i]));
  }
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

int BoxGrid::slotOf(const Bounds& box) const {
  if (!fits(box, half_)) return -1;
  const Cell c = cellAt(0.5 * (box.low + box.high));
  return (c[2] * cells_[1] + c[1]) * cells_[0] + c[0];
}

void BoxGrid::insert(int body, int slot) {
  const auto b = static_cast<std::size_t>(body);
  slot_[b] = slot;
  if (slot < 0) {
    large_.push_back(body);
    return;
  }
  int& first = first_[static_cast<std::size_t>(slot)];
  filed_[b].next = first;
  before_[b] = -1;
  if (first >= 0) before_[static_cast<std::size_t>(first)] = body;
  first = body;
}

void BoxGrid::remove(int body) {
  const auto b = static_cast<std::size_t>(body);
  if (slot_[b] < 0) {
    large_.erase(std::find(large_.begin(), large_.end(), body));
    return;
  }
  const int next = filed_[b].next;
  (before_[b] >= 0 ? filed_[static_cast<std::size_t>(before_[b])].next : first_[static_cast<std::size_t>(slot_[b])]) =
      next;
  if (next >= 0) before_[static_cast<std::size_t>(next)] = before_[b];
}

void BoxGrid::move(int body, const std::vector<Bounds>& boxes) {
  const auto b = static_cast<std::size_t>(body);
  file(body, boxes[b]);
  const int slot = slotOf(boxes[b]);
  if (slot == slot_[b]) return;
  remove(body);
  insert(body, slot);
}

void BoxGrid::file(int body, const Bounds& box) {
  Filed& filed = filed_[static_cast<std::size_t>(body)];
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    filed.low[k] = std::nextafter(static_cast<float>(box.low[i]), -kInfinite);
    filed.high[k] = std::nextafter(static_cast<float>(box.high[i]), kInfinite);
  }
}

void BoxGrid::find(int body, const std::vector<Bounds>& boxes, std::vector<int>& out) const {
  const Bounds& box = boxes[static_cast<std::size_t>(body)];
  const double reach = half_ * (1 + 1e-9);
  for (int other : large_)
    if (other != body && meet(box, boxes[static_cast<std::size_t>(other)])) out.push_back(other);
  const Filed mine = filed_[static_cast<std::size_t>(body)];
  const auto mayMeet = [&](const Filed& f) {
    return mine.low[0] <= f.high[0] && f.low[0] <= mine.high[0] && mine.low[1] <= f.high[1] &&
           f.low[1] <= mine.high[1] && mine.low[2] <= f.high[2] && f.low[2] <= mine.high[2];
  };
  const Cell low = cellAt(box.low.array() - reach), high = cellAt(box.high.array() + reach);
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x)
        for (int other = first_[static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x)]; other >= 0;) {
          const Filed& f = filed_[static_cast<std::size_t>(other)];
          if (mayMeet(f) && other != body && meet(box, boxes[static_cast<std::size_t>(other)])) out.push_back(other);
          other = f.next;
        }
}

}  // namespace carom
