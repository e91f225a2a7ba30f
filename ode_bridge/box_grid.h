#pragma once

#include <array>
#include <vector>

#include "ode_bridge/swept_bounds.h"

namespace carom {

/// Which boxes of many meet a given one, in a time that does not depend on how many there are: the collision library's
/// spaces answer for one body by walking through all. Every box is filed once, in the cell of its middle, and found
/// from the cells within half the largest size of the asked one. Boxes larger than that stand in a list of their own.
class BoxGrid {
 public:
  /// Files the boxes anew. Cells are laid for boxes of half size `half` and less.
  void rebuild(const std::vector<Bounds>& boxes, double half);
  /// The box of one body has changed.
  void move(int body, const std::vector<Bounds>& boxes);
  /// Adds the bodies other than `body` whose boxes meet that of `body`, in no particular order.
  void find(int body, const std::vector<Bounds>& boxes, std::vector<int>& out) const;

 private:
  using Cell = std::array<int, 3>;
  Cell cellAt(const Vec3& p) const;
  int slotOf(const Bounds& box) const;  // -1: large
  void insert(int body, int slot);
  void remove(int body);

  double half_ = 1, cell_size_ = 1;
  Vec3 corner_ = Vec3::Zero();
  Cell cells_{1, 1, 1};
  // What a search reads of a body, close together: its box, rounded outwards, and the next body of its cell.
  struct alignas(32) Filed {
    std::array<float, 3> low, high;
    int next;
  };
  void file(int body, const Bounds& box);

  std::vector<int> first_;          // of each cell, -1: none
  std::vector<Filed> filed_;        // of each body
  std::vector<int> before_, slot_;  // of each body: the one before it in its cell, and the cell
  std::vector<int> large_;
};

}  // namespace carom
