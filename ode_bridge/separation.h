#pragma once

#include "adjoint/arc.h"
#include "ode_bridge/features.h"
#include "ode_bridge/gaps.h"

namespace carom {

/// A solid in motion at one instant, with bounds on how its rotation can go on.
struct Placed {
  Placed(const Solid& solid, const Arc& arc, double t);

  Pose pose() const { return {k.x, k.R}; }

  const Solid* solid;
  Kinematics k;
  Vec3 acceleration;
  double spin, spin_rate;  ///< bounds on |omega| and |d omega/dt|; 0 for a ball, which looks the same from all sides
};

/// A direction along which two solids can be seen to be apart, and the features that face each other along it.
struct Witness {
  enum class Frame {
    world,    ///< the direction stays as it is
    body_a,   ///< it turns with a
    body_b,   ///< it turns with b
    crossed,  ///< it stays normal to an edge of a and an edge of b
  };
  Frame frame = Frame::world;
  Vec3 n = Vec3::UnitZ();                             ///< unit, from b to a
  double separation = 0;                              ///< of the solids along n, m; negative when they overlap along it
  bool bounding = false;                              ///< the solids are taken as their bounding balls
  FeaturePair features;                               ///< facing each other (not set when bounding)
  Vec3 edge_a = Vec3::Zero(), edge_b = Vec3::Zero();  ///< crossed: directions of the two edges
};

/// The direction of largest separation among those that decide (face normals, crossed edges, nearest points).
/// Solids far apart are seen as bounding balls.
Witness findWitness(const Placed& a, const Placed& b);

/// The separation along a given direction from b to a, as a witness that stays as it is in the world: any direction
/// along which solids are apart proves it.
Witness witnessAlong(const Placed& a, const Placed& b, const Vec3& n);

/// A time h in (0, limit] such that the solids cannot touch before t + h: along the witness direction every vertex is
/// followed to first order, with a bound on its second derivative over the whole step. `slack` > 0 is added to a
/// smaller separation, so that solids in contact which part can be stepped away from.
double safeStep(const Placed& a, const Placed& b, const Witness& witness, double slack, double limit);

}  // namespace carom
