// SPDX-License-Identifier: MIT
#pragma once

#include "ode_bridge/gaps.hpp"
#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// A direction along which two convex pieces, or two balls that hold more, can be seen to be apart.
struct Witness {
  enum class Frame {
    world,    ///< the direction stays as it is
    body_a,   ///< it turns with a
    body_b,   ///< it turns with b
    crossed,  ///< it stays normal to an edge of a and an edge of b
    tapered,  ///< it keeps its angles to an edge of a and an edge of b
  };
  Frame frame = Frame::world;
  Vec3 n = Vec3::UnitZ();                             ///< unit, from b to a
  double separation = 0;                              ///< along n, m; negative when they overlap along it
  double distance = 0;                                ///< an upper bound on their distance, by two points of them, m
  FeaturePair features;                               ///< facing each other; kind -1 where n comes from points alone
  Vec3 edge_a = Vec3::Zero(), edge_b = Vec3::Zero();  ///< crossed, tapered: directions of the two edges
};

/// The direction of largest separation of two pieces among those that decide: face normals, crossed edges and rims,
/// nearest points. `guess`, where it is not 0, is a direction from b to a to begin with; it saves time.
Witness findWitness(const PlacedPiece& a, const PlacedPiece& b, const Vec3& guess = Vec3::Zero());

/// The same by nearest points alone, for pieces that are well apart: no features are looked at.
Witness findDirection(const PlacedPiece& a, const PlacedPiece& b);

/// The separation along a given direction from b to a, as a witness that stays as it is in the world: any direction
/// along which solids are apart proves it.
Witness witnessAlong(const PlacedPiece& a, const PlacedPiece& b, const Vec3& n);

/// A ball that moves with a body: the node of a tree of pieces.
struct PlacedNode {
  const Placed* body;
  const Node* node;

  Vec3 arm() const { return body->k.R * node->center; }  ///< of the centre, world axes
};

/// The ball as a piece.
Piece ballOf(const Node& node);

/// Separation of two balls, or of a ball and the half space that the other one is, m.
double separationOf(const PlacedNode& a, const PlacedNode& b);

/// A time h in (0, limit] such that the pieces cannot touch before t + h: along the witness direction every point is
/// followed to first order, with a bound on its second derivative over the whole step. `slack` > 0 is added to a
/// smaller separation, so that pieces in contact which part can be stepped away from.
double safeStep(const PlacedPiece& a, const PlacedPiece& b, const Witness& witness, double slack, double limit);

/// The same for balls that are apart by `separation`.
double safeStep(const PlacedNode& a, const PlacedNode& b, double separation, double limit);

}  // namespace carom::ode_bridge_detail
