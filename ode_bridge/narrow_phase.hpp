// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// Candidate contacts from the collision library's dCollide, on geometries a little larger than the solids. Its depth,
/// normal and position are seeds and never the truth: the exact geometry decides what they are worth, and goes its own
/// way where the library finds nothing (it misses 5 to 13 % of contacts between boxes turned alike).
class NarrowPhase {
 public:
  NarrowPhase();
  ~NarrowPhase();
  NarrowPhase(const NarrowPhase&) = delete;
  NarrowPhase& operator=(const NarrowPhase&) = delete;

  void reset(const std::vector<Solid>& solids);

  /// Normal (from b to a) of a candidate contact of the two solids, each grown by `margin`; nothing when the library
  /// finds them further apart.
  std::optional<Vec3> candidateNormal(int a, int b, const Placed& placed_a, const Placed& placed_b,
                                      double margin) const;

 private:
  struct Geoms;
  std::unique_ptr<Geoms> geoms_;
};

}  // namespace carom::ode_bridge_detail
