// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "ode_bridge/swept_bounds.hpp"

namespace carom::ode_bridge_detail {

/// Which boxes of many meet a given one, in a time that does not depend on how many there are: the collision library's
/// spaces answer for one body by walking through all. Every box is filed once, in the cell of its middle, and found
/// from the cells within half the largest size of the asked one. Boxes larger than that, and those that find their cell
/// full, stand in a list of their own.
class BoxGrid {
 public:
  /// Files the boxes anew. Cells are laid for boxes of half size `half` and less.
  void rebuild(const std::vector<Bounds>& boxes, double half);
  /// The box of one body has changed.
  void move(int body, const std::vector<Bounds>& boxes);
  /// Adds the bodies other than `body` whose boxes meet that of `body`, in no particular order; may add some whose
  /// boxes miss it by less than the rounding of single precision.
  void find(int body, const std::vector<Bounds>& boxes, std::vector<int>& out) const;

 private:
  // What a search reads of a body, side by side with the others of its cell: its box, rounded outwards.
  struct alignas(32) Filed {
    std::array<float, 3> low, high;
    int body = -1;
  };
  using Cell = std::array<int, 3>;
  static constexpr std::size_t kDepth = 8;  // boxes in a cell

  Cell cellAt(const Vec3& p) const;
  int cellOf(const Bounds& box) const;  // -1: large
  static Filed filed(int body, const Bounds& box);
  Filed* placesOf(int cell) { return &places_[kDepth * static_cast<std::size_t>(cell)]; }
  void insert(int body, int cell, const Bounds& box);
  void remove(int body);

  double half_ = 1, cell_size_ = 1;
  Vec3 corner_ = Vec3::Zero();
  Cell cells_{1, 1, 1};
  std::vector<Filed> places_;  // kDepth of each cell, the taken ones first
  std::vector<int> cell_;      // of each body, -1: in the list of the large ones
  std::vector<int> large_;
};

}  // namespace carom::ode_bridge_detail
