// SPDX-License-Identifier: MIT
#include "ode_bridge/swept_bounds.hpp"

#include <algorithm>
#include <limits>

#include "ode_bridge/time_to.hpp"

namespace carom::ode_bridge_detail {

Bounds sweptCentre(const FlightPath& path, const Acceleration& acceleration, double from, double until) {
  const Vec3& g = acceleration.mean;
  const Vec3 p = path.positionAt(from, g), q = path.positionAt(until, g), v = path.velocityAt(from, g);
  Bounds b{p.cwiseMin(q), p.cwiseMax(q)};
  for (int k = 0; k < 3; ++k) {
    if (g[k] == 0) continue;
    const double summit = -v[k] / g[k];
    if (!(summit > 0 && summit < until - from)) continue;
    const double x = p[k] + 0.5 * v[k] * summit;
    b.low[k] = std::min(b.low[k], x);
    b.high[k] = std::max(b.high[k], x);
  }
  if (acceleration.variation == 0) return b;
  const double s = until - path.start;
  return grown(b, 0.5 * s * s * acceleration.variation);
}

Bounds grown(const Bounds& b, double room) { return {b.low.array() - room, b.high.array() + room}; }

double roundingRoom(const Bounds& b) {
  return 1e-9 * std::max(b.low.cwiseAbs().maxCoeff(), b.high.cwiseAbs().maxCoeff());
}

// Along each axis by the parabola of the least and that of the greatest acceleration.
double leavingTime(const FlightPath& path, const Acceleration& acceleration, double from, const Bounds& bounds) {
  const Vec3& g = acceleration.mean;
  const Vec3 p = path.positionAt(from, g), v = path.velocityAt(from, g);
  const auto across = [](double room, double speed, double pull) { return room > 0 ? timeTo(room, speed, pull) : 0; };
  double s = std::numeric_limits<double>::infinity();
  if (acceleration.variation == 0) {
    for (int k = 0; k < 3; ++k)
      s = std::min({s, across(bounds.high[k] - p[k], v[k], g[k]), across(p[k] - bounds.low[k], -v[k], -g[k])});
    return from + s;
  }
  const double more = acceleration.variation, before = from - path.start;
  const double faster = more * before, further = 0.5 * faster * before;
  for (int k = 0; k < 3; ++k)
    s = std::min({s, across(bounds.high[k] - p[k] - further, v[k] + faster, g[k] + more),
                  across(p[k] - bounds.low[k] - further, faster - v[k], more - g[k])});
  return from + s;
}

}  // namespace carom::ode_bridge_detail
