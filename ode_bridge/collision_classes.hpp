// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/scene/scene.h"

namespace carom::ode_bridge_detail {

/// Who may collide with whom (see mayCollide), answered in constant time: bodies of equal filters that are equally
/// movable are one class, and a table has an entry for every two classes.
class CollisionClasses {
 public:
  CollisionClasses() = default;
  explicit CollisionClasses(const Scene& scene);

  /// Every pair may collide, but for two fixed bodies.
  bool trivial() const { return count_ == 0; }
  bool collide(int a, int b) const {
    if (trivial()) return true;
    return table_[class_[static_cast<std::size_t>(a)] * count_ + class_[static_cast<std::size_t>(b)]];
  }

 private:
  std::size_t count_ = 0;
  std::vector<std::size_t> class_;  // of each body
  std::vector<bool> table_;
};

}  // namespace carom::ode_bridge_detail
