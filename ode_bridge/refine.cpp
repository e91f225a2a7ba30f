// SPDX-License-Identifier: MIT
#include "ode_bridge/refine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_bridge/rounding.hpp"

namespace carom::ode_bridge_detail {
namespace {

// An approach along n slower than this cannot be told from none. What a body spins by about n moves nothing along n, but
// for its rounding.
double stillSpeed(const Placed& a, const Placed& b, const Vec3& n) {
  double speed = a.k.v.norm() + b.k.v.norm(), spinning = 0;
  for (const Placed* p : {&a, &b}) {
    if (!(p->spin > 0)) continue;
    speed += n.cross(p->k.w).norm() * p->solid->bound();
    spinning += p->spin * p->solid->bound();
  }
  return kStill * speed + 32 * kEps * spinning;
}

double gapRate(const Placed& a, const Placed& b, const ContactPoint& c) {
  return c.normal.dot(a.k.v + a.k.w.cross(c.point - a.k.x) - b.k.v - b.k.w.cross(c.point - b.k.x));
}

}  // namespace

Root refineRoot(const PairMotion& pair, const FeaturePair& features, double from, double t, const Placed& a0,
                const Placed& b0) {
  const auto contact = [&](const Placed& a, const Placed& b) {
    return pair.geometry.contact(pair.a, pair.b, features, {a.k.x, a.k.R}, {b.k.x, b.k.R});
  };
  ContactPoint c = contact(a0, b0);
  double rate = gapRate(a0, b0, c);
  if (!(rate < -stillSpeed(a0, b0, c.normal))) return {t, false};
  double best = std::abs(c.gap);
  for (int round = 0; round < 6; ++round) {
    const double next = std::max(from, t - c.gap / rate);
    if (std::abs(next - t) <= 2 * kEps * std::max(1.0, t)) return {next, true};
    pair.arc_a.extendTo(next);
    pair.arc_b.extendTo(next);
    const Placed a(*a0.solid, pair.arc_a, next), b(*b0.solid, pair.arc_b, next);
    c = contact(a, b);
    const double new_rate = gapRate(a, b, c);
    if (!(std::abs(c.gap) < best) || !(new_rate < 0)) return {std::abs(c.gap) <= best ? next : t, true};
    best = std::abs(c.gap);
    rate = new_rate;
    t = next;
  }
  return {t, true};
}

}  // namespace carom::ode_bridge_detail
