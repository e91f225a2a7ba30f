// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ode_bridge/swept_bounds.hpp"

namespace carom::ode_bridge_detail {

/// Pairs of bodies whose bounds meet, by the collision library's sweep-and-prune space. Half spaces are known to it as
/// such. Fixed bodies are not paired with each other.
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
  /// All pairs (a < b) whose bounds meet, each once, in no particular order. A half space is named with all bodies that
  /// its own axis-aligned bounds meet.
  void pairs(std::vector<std::pair<int, int>>& out) const;

 private:
  struct Space;
  std::unique_ptr<Space> space_;
};

}  // namespace carom::ode_bridge_detail
