// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "adjoint/motion/motion.h"
#include "tests/reference/numbers.h"

namespace carom::reference {

struct Coefficients {
  Real elasticity, friction, tangential_elasticity;
};

inline Real combined(Combine a, Combine b, const Real& x, const Real& y) {
  switch (std::min(a, b)) {  // declared in order of precedence
    case Combine::average:
      return (x + y) / 2;
    case Combine::minimum:
      return std::min(x, y);
    case Combine::maximum:
      return std::max(x, y);
    case Combine::multiply:
      return x * y;
  }
  throw std::logic_error("no such rule");
}

inline Coefficients combined(const MaterialNumbers& a, const MaterialNumbers& b) {
  return {combined(a.combine_elasticity, b.combine_elasticity, a.elasticity, b.elasticity),
          combined(a.combine_friction, b.combine_friction, a.friction, b.friction),
          (a.tangential_elasticity + b.tangential_elasticity) / 2};
}

/// One side of an impact.
struct Side {
  bool moving = false;
  Real inverse_mass = 0;
  RVec inverse_inertia;  ///< principal
  RMat R;                ///< principal to world
  RVec arm;              ///< contact point - centre of mass
  RVec velocity, spin;
  RVec surface = RVec();  ///< velocity of the surface's material beside the body's

  RVec pointVelocity() const { return moving ? velocity + cross(spin, arm) : RVec(); }
  /// Velocity that a unit impulse P at the contact gives to the contact point.
  RVec mobility(const RVec& P) const {
    if (!moving) return {};
    const RVec dspin = R * times(inverse_inertia, transposeTimes(R, cross(arm, P)));
    return inverse_mass * P + cross(dspin, arm);
  }
};

/// What the smallest turn from `from` to `to`, both of length 1, makes of v.
inline RVec smallestTurn(const RVec& from, const RVec& to, const RVec& v) {
  const RVec axis = cross(from, to), once = cross(axis, v);
  return v + once + (1 / (1 + dot(from, to))) * cross(axis, once);
}

/// (n + alpha t1 + beta t2)/|...|: t1 is turned along with the normal from m, where it is such that that of the z axis
/// is y; t2 = n x t1.
inline RVec tilted(const RVec& n, const std::array<Real, 2>& tilt) {
  const RVec m = unit(axisVector(0, Real(282)) + axisVector(1, Real(-367)) + axisVector(2, Real(886)));
  const RVec t1 = smallestTurn(m, n, smallestTurn(axisVector(2), m, axisVector(1))), t2 = cross(n, t1);
  return unit(n + tilt[0] * t1 + tilt[1] * t2);
}

/// Impulse on a by laws 4.1 and 4.2 of docs/equations.md, along the branch `mode`; when `decide`, the branch is found.
inline RVec impulseOf(const Side& a, const Side& b, const RVec& n, const Coefficients& c, ImpactMode& mode,
                      bool decide) {
  RMat K;
  for (int j = 0; j < 3; ++j) K.column[j] = a.mobility(axisVector(j)) + b.mobility(axisVector(j));
  const RVec u = a.pointVelocity() + a.surface - b.pointVelocity() - b.surface;
  const RVec P_I = (-dot(n, u) / dot(n, K * n)) * n;
  if (decide && c.friction == 0) mode = ImpactMode::frictionless;
  if (decide && c.friction == 0) return (1 + c.elasticity) * P_I;

  const RVec P_II = -solve(K, u), difference = P_II - P_I;
  const RVec P = (1 + c.elasticity) * P_I + (1 + c.tangential_elasticity) * difference;
  const auto tangential = [&n](const RVec& p) { return norm(p - dot(n, p) * n); };
  // without friction it slides with a coefficient of 0, which varies
  if (decide) mode = tangential(P) <= c.friction * dot(n, P) ? ImpactMode::stick : ImpactMode::slide;
  if (mode == ImpactMode::stick) return P;
  const bool slips = tangential(P_II) > Real(1e-13) * norm(P_I);
  if (mode == ImpactMode::frictionless && !slips) return (1 + c.elasticity) * P_I;
  const Real kappa =
      c.friction * (1 + c.elasticity) * dot(n, P_I) / (tangential(P_II) - c.friction * dot(n, difference));
  return (1 + c.elasticity) * P_I + kappa * difference;
}

}  // namespace carom::reference
