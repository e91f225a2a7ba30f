// SPDX-License-Identifier: MIT
#include "ode_bridge/swept_bounds.hpp"

#include <algorithm>
#include <limits>

#include "ode_bridge/time_to.hpp"

namespace carom::ode_bridge_detail {

Bounds sweptCentre(const FlightPath& path, const Vec3& g, double from, double until) {
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
  return b;
}

Bounds grown(const Bounds& b, double room) { return {b.low.array() - room, b.high.array() + room}; }

double roundingRoom(const Bounds& b) {
  return 1e-9 * std::max({1.0, b.low.cwiseAbs().maxCoeff(), b.high.cwiseAbs().maxCoeff()});
}

double leavingTime(const FlightPath& path, const Vec3& g, double from, const Bounds& bounds) {
  const Vec3 p = path.positionAt(from, g), v = path.velocityAt(from, g);
  const auto across = [](double room, double speed, double pull) { return room > 0 ? timeTo(room, speed, pull) : 0; };
  double s = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    s = std::min({s, across(bounds.high[k] - p[k], v[k], g[k]), across(p[k] - bounds.low[k], -v[k], -g[k])});
  return from + s;
}

}  // namespace carom::ode_bridge_detail
