// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ode_bridge/contact_at.hpp"
#include "ode_bridge/ground.hpp"
#include "ode_bridge/separation.hpp"

namespace carom::ode_bridge_detail {

/// Adds the feature pairs of two pieces that touch (gap of at most `tolerance`, within their extents, with the normal
/// in the cones of both): more than one where an edge or a face lies on a face. Pairs that are the same contact as one
/// that is there already (same point, same normal) are left out. `witness` is that of the instant.
void addTouching(const PlacedPiece& a, const PlacedPiece& b, const Witness& witness, double tolerance,
                 std::vector<FeaturePair>& found);

/// Adds those of edges that lie along each other, with the outermost of their normals (docs/collision.md).
void addAlongEdges(const PlacedPiece& a, const PlacedPiece& b, const Witness& witness, double tolerance,
                   std::vector<FeaturePair>& found);

/// Bodies that overlap by less than this many tolerances of contact touch.
inline constexpr double kOverlap = 1e4;

/// The same of all pieces of two bodies: gaps of at most `reach`, and overlaps that small. A contact where parts of a
/// body lie flush, or fixed bodies do, is one with the faces.
std::vector<FeaturePair> touchingFeatures(const Placed& a, const Placed& b, double reach, const GroundBeside& ground = {});

}  // namespace carom::ode_bridge_detail
