// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"
#include "tests/random/solid.h"
#include "tests/support/brute/flight.h"

namespace carom::brute {

struct Coefficients {
  Real elasticity, friction, tangential_elasticity;
};
/// Coefficients of a pair of bodies by the combine rules.
Coefficients combined(const Scene& scene, const Body& a, const Body& b);

struct Velocity {
  Vector v, w;
};

/// Equations 4.1 (no friction) and 4.2 of docs/equations.md at one contact: velocities of a and b after it.
std::pair<Velocity, Velocity> afterImpact(const MassProperties& mass_a, const Kinematic& a,
                                          const MassProperties& mass_b, const Kinematic& b, const Contact& contact,
                                          const Coefficients& c);

/// The same, and an impulse that leaves no velocity at the contact: of bodies that stay there.
std::pair<Velocity, Velocity> stoppedAt(const MassProperties& mass_a, const Kinematic& a, const MassProperties& mass_b,
                                        const Kinematic& b, const Contact& contact,
                                        const std::pair<Velocity, Velocity>& after);

/// One of several contacts of an impact: impulse on a, relative velocities before and after it.
struct JointContact {
  Vector n, impulse, before, after;
  Coefficients pair;
};
/// By how much it fails what equation 4.4 asks of it, in m/s and shares of the impulse: P_n >= 0, |P_t| <= mu P_n,
/// u_n+ >= -e u_n, and equal where P_n > 0. What is below the rounding of the `largest` impulse of them is none.
Real violationOf(const JointContact& c, Real largest);

}  // namespace carom::brute
