// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// Nearest points of two cores, as far as an iteration of support points finds them.
struct CoreDistance {
  Vec3 from_b_to_a = Vec3::Zero();  ///< between the nearest points found, world axes
  double upper = 0;                 ///< their distance: the cores are no further apart, m
  double lower = 0;                 ///< the cores are at least that far apart (0 when not known to be), m
  Vec3 normal = Vec3::UnitZ();      ///< unit, the direction along which `lower` holds
  Vec3 at_a, at_b;                  ///< the nearest points, seen from b's origin, world axes
  bool overlap = false;             ///< the cores have a point in common
  /// The points of each core that the nearest point is a mix of; one, two or three different ones.
  int count = 0;
  std::array<Vec3, 4> of_a, of_b;
};

/// The method of Gilbert, Johnson and Keerthi (1988): exact for polytopes but for rounding, `lower` within a share of
/// 1e-8 of `upper` for cylinders. Neither piece may be a half space. `guess` is a direction from b to a to start with.
CoreDistance coreDistance(const PlacedPiece& a, const PlacedPiece& b, const Vec3& guess);

}  // namespace carom::ode_bridge_detail
