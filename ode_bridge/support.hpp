// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/flight/arc.h"
#include "ode_bridge/solids/solid.hpp"

namespace carom::ode_bridge_detail {

/// A solid in motion at one instant, with bounds on how its rotation can go on.
struct Placed {
  Placed(const Solid& solid, const Arc& arc, double t);
  /// At rest.
  Placed(const Solid& solid, const Vec3& x, const Mat3& R);

  Vec3 world(const Vec3& p) const { return k.x + k.R * p; }

  const Solid* solid;
  Kinematics k;
  Vec3 acceleration;
  double variation = 0;      ///< the acceleration stays within so much of this one, m/s^2
  double spin, spin_rate;  ///< bounds on |omega| and |d omega/dt|; 0 for a ball, which looks the same from all sides
  const Arc* arc = nullptr;  ///< outlives this; null at rest
};

/// One convex piece of a solid in motion.
struct PlacedPiece {
  const Placed* body;
  const Piece* piece;

  const Solid& solid() const { return *body->solid; }
  std::span<const int> featuresOf(Family family) const { return solid().featuresOf(*piece, family); }
  bool halfSpace() const { return piece->core == Piece::Core::half_space; }
  /// Radius about the solid's origin that holds the core.
  double coreRadius() const { return piece->center.norm() + piece->core_radius; }
};

/// The point of a core that lies furthest along a direction, both in the solid's axes. `index` is that of the support
/// point in Solid::points; -1 on a frustum.
struct Support {
  Vec3 at;
  int index;
};
Support supportOf(const Solid& solid, const Piece& piece, const Vec3& direction);

/// The end of a frustum that its point furthest along a direction is at: 1 for the high one, -1 for the low one.
int furthestEnd(const Piece& piece, const Vec3& direction);

/// How far the core reaches along a world direction, seen from the body's origin.
double extentAlong(const PlacedPiece& p, const Vec3& direction);

/// Separation of two pieces along a unit world direction n from b to a, m: whatever n is, they are at least that far
/// apart. Swept radii count.
double separationAlong(const PlacedPiece& a, const PlacedPiece& b, const Vec3& n);

}  // namespace carom::ode_bridge_detail
