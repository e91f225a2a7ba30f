// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/body_distance.hpp"
#include "ode_bridge/separation.hpp"

/// Nearest points of bodies that are apart, and the features that they lie on.
namespace carom::ode_bridge_detail {

/// Upper and lower bound on the distance of two pieces, equal but for rounding on polytopes; the lower one may be
/// below 0.
struct PieceDistance {
  double upper = 0, lower = 0;  ///< m
  Vec3 at_a = Vec3::Zero(), at_b = Vec3::Zero();  ///< nearest points of the cores, world; of a half space not set
};
PieceDistance pieceDistance(const PlacedPiece& a, const PlacedPiece& b);

/// What is asked of bodies that overlap.
enum class WhereOverlapping {
  nothing,  ///< their distance is 0
  depth     ///< their separation is below 0, see adjoint_detail::BodyDistance::separation
};

/// Of all pieces of two bodies.
adjoint_detail::Nearest nearestOf(const Placed& a, const Placed& b,
                                  WhereOverlapping overlap = WhereOverlapping::nothing);

/// A pair of features whose gap may be the distance of two pieces.
struct NearPlace {
  FeaturePair features;
  ContactPoint at;
  double separation = 0;  ///< of the pieces along its normal, m
  bool mark = false;      ///< stands for a rim that lies flat
};

/// Rate of the gap of the features of two bodies in motion, m/s.
double gapRateOf(const Placed& a, const Placed& b, const FeaturePair& features);

/// See adjoint_detail::BodyDistance.
std::optional<adjoint_detail::NearestInTime> nearestInTimeOf(
    const Solid& a, const Solid& b, const Arc& arc_a, const Arc& arc_b, double from, double to, double under,
    WhereOverlapping overlap = WhereOverlapping::nothing);

}  // namespace carom::ode_bridge_detail
