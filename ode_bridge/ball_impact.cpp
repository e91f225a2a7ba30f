// SPDX-License-Identifier: MIT
#include "ode_bridge/ball_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode_bridge/rounding.hpp"
#include "ode_bridge/time_to.hpp"

namespace carom::ode_bridge_detail {
namespace {

struct GapAndRate {
  double gap, rate;
};

// Newton on the gap from a time at which it is zero but for rounding; the time of the smallest gap that it meets.
template <class GapAt>
double polish(const GapAt& gap_at, double from, double t) {
  double best = std::numeric_limits<double>::infinity(), best_time = t;
  for (int round = 0; round < 6; ++round) {
    const GapAndRate at = gap_at(t);
    if (!(std::abs(at.gap) < best)) break;
    best = std::abs(at.gap);
    best_time = t;
    if (!(at.rate < 0)) break;
    const double next = std::max(from, t - at.gap / at.rate);
    if (std::abs(next - t) <= 2 * kEps * t) return next;
    t = next;
  }
  return best_time;
}

}  // namespace

BallImpact ballBallImpact(const FlightPath& a, const FlightPath& b, const Vec3& g, double from, double until) {
  const Vec3 d = a.positionAt(from, g) - b.positionAt(from, g), w = a.velocityAt(from, g) - b.velocityAt(from, g);
  const double dw = d.dot(w);
  if (!(dw < 0)) return {};  // not nearing, and never will
  const double R = a.radius + b.radius, w2 = w.squaredNorm();
  const double distance = d.norm(), c = (distance - R) * (distance + R);
  if (c > 0 && -dw * (until - from) < 0.5 * c && w2 * (until - from) < -dw) return {};  // too far for the time left
  // in touch already: what c has is rounding, and balls that do not near each other part
  const double speeds_now = a.velocityAt(from, g).norm() + b.velocityAt(from, g).norm();
  const double size = std::max({a.positionAt(from, g).cwiseAbs().maxCoeff(), b.positionAt(from, g).cwiseAbs().maxCoeff(), R});
  if (distance - R <= kTouch * size && !(-dw > kStill * speeds_now * distance)) return {};
  const double room = std::sqrt(w2) * R, miss = d.cross(w).norm();
  const double D = (room - miss) * (room + miss);
  if (!(D > 0)) return {};
  const double root = std::sqrt(D);
  const double s = c > 0 ? c / (root - dw) : 0;
  if (!(from + s <= until)) return {};
  const double time = polish(
      [&](double t) {
        const Vec3 e = a.positionAt(t, g) - b.positionAt(t, g);
        const double l = e.norm();
        return GapAndRate{l - R, e.dot(a.velocityAt(t, g) - b.velocityAt(t, g)) / l};
      },
      from, from + s);
  const double speeds = a.velocityAt(time, g).norm() + b.velocityAt(time, g).norm();
  if (!(time <= until) || !(root > kStill * speeds * R)) return {};
  return {BallImpact::Found::impact, time};
}

BallImpact ballPlaneImpact(const FlightPath& ball, const Vec3& g, const Vec3& normal, double offset, double from,
                           double until) {
  const auto gap_at = [&](double t) {
    return GapAndRate{normal.dot(ball.positionAt(t, g)) - offset - ball.radius, normal.dot(ball.velocityAt(t, g))};
  };
  const auto [h, v] = gap_at(from);
  const double a = normal.dot(g);
  const double touch = kTouch * std::max(ball.positionAt(from, g).cwiseAbs().maxCoeff(), ball.radius);
  const double still = kStill * ball.velocityAt(from, g).norm();
  if (h <= touch && std::abs(v) <= std::max(still, std::sqrt(2 * std::abs(a) * touch))) {
    if (v >= 0 && a > 0) return {};  // it parts
    return {BallImpact::Found::undecided, from};
  }
  double s = h > 0 ? timeTo(h, -v, -a) : 0;
  if (h <= 0 && v >= 0) {
    if (!(a < 0)) return {};
    s = (v + std::sqrt(std::max(0.0, v * v - 2 * a * h))) / -a;  // up and down again
  }
  if (!(from + s <= until)) return {};
  const double time = polish(gap_at, from, from + s);
  if (!(time <= until)) return {};
  if (!(gap_at(time).rate < -kStill * ball.velocityAt(time, g).norm())) return {};
  return {BallImpact::Found::impact, time};
}

}  // namespace carom::ode_bridge_detail
