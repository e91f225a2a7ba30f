#pragma once

#include <memory>
#include <vector>

#include "adjoint/types.h"

namespace carom {

/// Axis-aligned box in the world.
struct Bounds {
  Vec3 low, high;
};

/// Pairs of bodies whose bounds meet, by the collision library's sweep-and-prune space. Half spaces are known to it as
/// such. Fixed bodies are not reported to each other.
class BroadPhase {
 public:
  BroadPhase();
  ~BroadPhase();
  BroadPhase(const BroadPhase&) = delete;
  BroadPhase& operator=(const BroadPhase&) = delete;

  /// Starts again with `count` bodies that have no bounds yet.
  void reset(std::size_t count);
  void setBounds(int body, const Bounds& bounds, bool moving);
  /// The half space { p : normal . p <= offset }, fixed.
  void setHalfSpace(int body, const Vec3& normal, double offset);
  /// Bodies whose bounds meet those of `body`, in increasing order.
  void neighbours(int body, std::vector<int>& out) const;

 private:
  struct Space;
  std::unique_ptr<Space> space_;
};

}  // namespace carom
