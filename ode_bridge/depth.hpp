// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "ode_bridge/nearest.hpp"

/// How deep two convex pieces overlap.
namespace carom::ode_bridge_detail {

/// The direction that separates two pieces most, though they overlap along all of them.
struct Depth {
  double separation = 0;          ///< m, below 0 but for rounding
  std::vector<NearPlace> places;  ///< features whose normal is that direction; none where every direction is as good
  std::optional<Witness> witness;  ///< of the first place
};

/// Nothing where the cores are apart: nearest points then say all. Directions are tried that are normal to a face, or to
/// two edges or rims; a sharp vertex has none of its own.
std::optional<Depth> depthOf(const PlacedPiece& a, const PlacedPiece& b);

}  // namespace carom::ode_bridge_detail
