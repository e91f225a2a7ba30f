// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom::ode_bridge_detail {

/// Axis-aligned box in the world.
struct Bounds {
  Vec3 low, high;
};

inline bool meet(const Bounds& a, const Bounds& b) {
  // one axis after the other: most boxes are apart along the first
  return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
         a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

/// How a body accelerates: always within `variation` of `mean`, m/s^2.
struct Acceleration {
  Vec3 mean = Vec3::Zero();
  double variation = 0;
  bool operator==(const Acceleration&) const = default;
};

/// The path of a body as the broad phase sees it: the ball that bounds it, on a parabola.
///   x(t) = x + s (v + s g / 2), s = t - start; g is the same for most that move and not kept here. Where it varies
/// by up to d, x(t) is known to s^2 d / 2.
struct alignas(64) FlightPath {
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();
  double start = 0;
  double radius = 0;  ///< of a ball its own; otherwise one about the centre of mass that holds the body

  Vec3 positionAt(double t, const Vec3& g) const {
    const double s = t - start;
    return x + s * (v + 0.5 * s * g);
  }
  Vec3 velocityAt(double t, const Vec3& g) const { return v + (t - start) * g; }
};

/// Everywhere that the centre can be between two times: the parabola's ends and its summits, and what is not known.
Bounds sweptCentre(const FlightPath& path, const Acceleration& g, double from, double until);

/// The box grown by `room` on all sides.
Bounds grown(const Bounds& bounds, double room);

/// Room for the rounding of positions and for the tolerance of contact, for a body in this box.
double roundingRoom(const Bounds& bounds);

/// The first time from `from` on at which the centre can leave the box; infinite if it never does, `from` if it is
/// outside.
double leavingTime(const FlightPath& path, const Acceleration& g, double from, const Bounds& bounds);

}  // namespace carom::ode_bridge_detail
