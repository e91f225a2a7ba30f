// SPDX-License-Identifier: MIT
#include "tests/random/impact_law.h"

#include <Eigen/LU>
#include <algorithm>

namespace carom::brute {
namespace {

Real combine(Combine rule, double p, double q) {
  const Real a = p, b = q;
  switch (rule) {
    case Combine::average:
      return (a + b) / 2;
    case Combine::minimum:
      return std::min(a, b);
    case Combine::maximum:
      return std::max(a, b);
    case Combine::multiply:
      break;
  }
  return a * b;
}

Matrix cross(const Vector& r) {
  Matrix m;
  m << 0, -r[2], r[1], r[2], 0, -r[0], -r[1], r[0], 0;
  return m;
}

}  // namespace

Coefficients combined(const Scene& scene, const Body& a, const Body& b) {
  const Material &p = materialOf(scene, a), &q = materialOf(scene, b);
  return {combine(std::min(p.combine_elasticity, q.combine_elasticity), p.elasticity, q.elasticity),
          combine(std::min(p.combine_friction, q.combine_friction), p.friction, q.friction),
          combine(Combine::average, p.tangential_elasticity, q.tangential_elasticity)};
}

std::pair<Velocity, Velocity> afterImpact(const MassProperties& mass_a, const Kinematic& a,
                                          const MassProperties& mass_b, const Kinematic& b, const Contact& contact,
                                          const Coefficients& c) {
  const Vector n = contact.n, ra = contact.p - a.x, rb = contact.p - b.x;
  const Vector u = a.v + a.w.cross(ra) - b.v - b.w.cross(rb);
  const Matrix Ja = inverseInertia(mass_a, a.R), Jb = inverseInertia(mass_b, b.R);
  const Matrix K = (mass_a.inverse_mass + mass_b.inverse_mass) * Matrix::Identity() - cross(ra) * Ja * cross(ra) -
                   cross(rb) * Jb * cross(rb);
  const Real e = c.elasticity, mu = c.friction;
  const Vector plastic = -u.dot(n) / n.dot(K * n) * n;
  Vector P = (1 + e) * plastic;
  if (mu > 0) {
    const Vector stick = K.partialPivLu().solve(-u), rest = stick - plastic;
    const Vector whole = P + (1 + c.tangential_elasticity) * rest;
    const Real whole_n = whole.dot(n);
    if ((whole - whole_n * n).norm() <= mu * whole_n) {
      P = whole;
    } else {
      const Real stick_t = (stick - stick.dot(n) * n).norm();
      P += mu * (1 + e) * plastic.dot(n) / (stick_t - mu * rest.dot(n)) * rest;
    }
  }
  return {{a.v + mass_a.inverse_mass * P, a.w + Ja * ra.cross(P)},
          {b.v - mass_b.inverse_mass * P, b.w - Jb * rb.cross(P)}};
}

std::pair<Velocity, Velocity> stoppedAt(const MassProperties& mass_a, const Kinematic& a, const MassProperties& mass_b,
                                        const Kinematic& b, const Contact& contact,
                                        const std::pair<Velocity, Velocity>& after) {
  const Vector ra = contact.p - a.x, rb = contact.p - b.x;
  const auto& [va, vb] = after;
  const Matrix Ja = inverseInertia(mass_a, a.R), Jb = inverseInertia(mass_b, b.R);
  const Matrix K = (mass_a.inverse_mass + mass_b.inverse_mass) * Matrix::Identity() - cross(ra) * Ja * cross(ra) -
                   cross(rb) * Jb * cross(rb);
  const Vector P = K.partialPivLu().solve(-(va.v + va.w.cross(ra) - vb.v - vb.w.cross(rb)));
  return {{va.v + mass_a.inverse_mass * P, va.w + Ja * ra.cross(P)},
          {vb.v - mass_b.inverse_mass * P, vb.w - Jb * rb.cross(P)}};
}

Real violationOf(const JointContact& c, Real largest) {
  const Real rounding = 1e-15L * largest, P = c.impulse.norm(), P_n = c.n.dot(c.impulse), P_t = (c.impulse - P_n * c.n).norm();
  const Real spare = c.n.dot(c.after) + c.pair.elasticity * c.n.dot(c.before);
  Real worst = std::max<Real>(0, -spare);
  if (P > rounding) worst = std::max({worst, -P_n / P, (P_t - c.pair.friction * P_n) / P});
  if (P_n > rounding) worst = std::max(worst, spare);
  return worst;
}

}  // namespace carom::brute
