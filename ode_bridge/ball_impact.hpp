// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "ode_bridge/swept_bounds.hpp"

namespace carom::ode_bridge_detail {

/// First impact of balls, in closed form.
struct BallImpact {
  enum class Found {
    none,
    impact,
    undecided,  ///< at rest against each other but for rounding: the general search has to follow them
  };
  Found found = Found::none;
  double time = 0;
};

/// A ball at one moment.
struct BallNow {
  Vec3 x, v;
  double radius;
};

/// What is known of two balls under the same acceleration by a few products.
struct Approach {
  bool overlap;  ///< they do, within rounding
  bool meet;     ///< they may come to touch, while nearing each other, in the time looked at
};

/// `meet` is false only where the balls surely do not: that spares most pairs the exact answer.
inline Approach approachOf(const BallNow& ball, const FlightPath& other, const Vec3& g, double from, double until) {
  const double s = from - other.start, T = until - from;
  const Vec3 d = ball.x - other.x - s * (other.v + 0.5 * s * g), w = ball.v - other.v - s * g;
  const double dw = d.dot(w), R = ball.radius + other.radius, d2 = d.squaredNorm(), w2 = w.squaredNorm();
  const double c = d2 - R * R, rounding = 1e-12 * d2 + 1e-14 * ball.x.squaredNorm();
  // |d + s w|^2 - R^2 >= c + 2 s d.w, and its least value is c - (d.w)^2 / |w|^2;
  // without branches: which of the three says no is a toss-up
  return {c <= rounding, bool(int(dw < 0) & int(c + 2 * T * dw <= rounding) & int(w2 * (c - rounding) <= dw * dw))};
}

/// Whether a ball may touch a fixed half space from `from` until then; false only where it surely does not.
inline bool mayTouch(const BallNow& ball, const Vec3& g, const Vec3& normal, double offset, double from, double until) {
  const double h = normal.dot(ball.x) - offset - ball.radius, v = normal.dot(ball.v), a = normal.dot(g);
  const double T = until - from;
  const double lowest = std::min(h, h + T * (a < 0 ? v + 0.5 * T * a : v));
  return lowest <= 1e-9 * (std::abs(offset) + ball.radius + T * std::abs(v));
}

/// Two balls under the same acceleration g fly straight relative to each other: with d = x_a - x_b and w = v_a - v_b at
/// `from` and R = r_a + r_b, |d + s w| = R at
///   s = c / (-d.w + sqrt(D)),  c = |d|^2 - R^2,  D = (d.w)^2 - |w|^2 c = |w|^2 R^2 - |d x w|^2,
/// where the approach n.w = -sqrt(D)/R. Then Newton on the gap, from the paths as they are. Balls that touch and do not
/// approach are not an impact.
BallImpact ballBallImpact(const FlightPath& a, const FlightPath& b, const Vec3& g, double from, double until);

/// A ball and the fixed half space normal . p <= offset: height h(s) = h + h' s + n.g s^2/2, its first zero with a
/// decreasing height.
BallImpact ballPlaneImpact(const FlightPath& ball, const Vec3& g, const Vec3& normal, double offset, double from,
                           double until);

}  // namespace carom::ode_bridge_detail
