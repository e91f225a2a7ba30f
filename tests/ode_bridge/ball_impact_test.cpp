// SPDX-License-Identifier: MIT
// Closed-form impacts of balls against the same roots in extended precision; and the cheap look ahead never says no
// where they meet.

#include "ode_bridge/ball_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace carom {

using namespace ode_bridge_detail;

namespace {

using test::Random;
using Real = long double;
using RealVec = Eigen::Matrix<Real, 3, 1>;

RealVec at(const FlightPath& p, const Vec3& g, Real t) {
  const Real s = t - Real(p.start);
  return p.x.cast<Real>() + s * (p.v.cast<Real>() + s / 2 * g.cast<Real>());
}
RealVec speed(const FlightPath& p, const Vec3& g, Real t) {
  return p.v.cast<Real>() + (t - Real(p.start)) * g.cast<Real>();
}

BallNow now(const FlightPath& p, const Vec3& g, double t) { return {p.positionAt(t, g), p.velocityAt(t, g), p.radius}; }

// First root of |d + s w| = R, or a negative number.
Real meetingOf(const FlightPath& a, const FlightPath& b, const Vec3& g, double from) {
  const RealVec d = at(a, g, from) - at(b, g, from), w = speed(a, g, from) - speed(b, g, from);
  const Real R = Real(a.radius) + Real(b.radius), dw = d.dot(w), c = d.squaredNorm() - R * R;
  const Real D = w.squaredNorm() * R * R - d.cross(w).squaredNorm();
  return dw < 0 && D > 0 ? Real(from) + c / (std::sqrt(D) - dw) : -1;
}

TEST(BallImpact, TwoBallsAgainstExtendedPrecision) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Vec3 g = random.below(2) ? Vec3(0, 0, -9.81) : Vec3(0.3, 2, 1);
    const double size = std::pow(10, random.in(-3, 0));
    FlightPath a{random.vec(1), random.vec(2), random.in(0, 1), size}, b{random.vec(1), random.vec(2), 0.5, 2 * size};
    const double from = 1, until = from + random.in(0.1, 2);
    // aimed, every other time, from a start at `from`
    if (random.below(2)) {
      a.start = from;
      a.v = b.velocityAt(from, g) + random.in(0.6, 3) * (b.positionAt(from, g) - a.x + random.vec(2 * size));
    }
    if ((at(a, g, from) - at(b, g, from)).norm() < 3.001 * size) continue;
    const Real expected = meetingOf(a, b, g, from);
    if (std::abs(expected - Real(until)) < 1e-9L) continue;
    const BallImpact found = ballBallImpact(a, b, g, from, until);
    const bool meets = expected > 0 && expected < until;
    EXPECT_EQ(found.found == BallImpact::Found::impact, meets) << double(expected);
    if (!meets || found.found != BallImpact::Found::impact) continue;
    ++met;
    // the rounding of positions, over the speed of approach
    const RealVec d = at(a, g, expected) - at(b, g, expected), w = speed(a, g, expected) - speed(b, g, expected);
    const double approach = -double(d.dot(w) / d.norm());
    const double places = 1 + double(at(a, g, expected).norm() + at(b, g, expected).norm());
    const double error = std::abs(double(Real(found.time) - expected));
    EXPECT_TRUE(error <= 5e-16 + 1e-15 * places / approach) << error << " at an approach of " << approach;
    EXPECT_TRUE(approachOf(now(a, g, from), b, g, from, until).meet);
    EXPECT_TRUE(approachOf(now(b, g, from), a, g, from, found.time * (1 + 1e-12)).meet);
  }
  EXPECT_GT(met, 500);
}

// Balls in touch to rounding that go along each other part, whatever sign the rounding of their approach has; what nears clearly meets at once.
TEST(BallImpact, WhatTouchesAndGoesAlongParts) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Vec3 n = random.unit(), g(0, 0, -9.81);
    const double R = random.in(0.1, 1);
    FlightPath a{random.vec(1), random.vec(2), 1, 0.4 * R}, b{a.x + R * n, a.v + n.cross(random.vec(1)), 1, 0.6 * R};
    EXPECT_EQ(ballBallImpact(a, b, g, 1, 5).found, BallImpact::Found::none);
    b.v -= 1e-3 * n;
    EXPECT_EQ(ballBallImpact(a, b, g, 1, 5).found, BallImpact::Found::impact);
  }
}

TEST(BallImpact, BallAndPlaneAgainstExtendedPrecision) {
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Vec3 g = random.below(3) ? Vec3(0, 0, -9.81) : Vec3::Zero(), n = random.unit();
    const FlightPath ball{random.vec(1), random.vec(3), random.in(0, 1), random.in(0.01, 0.2)};
    const double from = 1, until = from + random.in(0.1, 2);
    const double offset = n.dot(ball.positionAt(from, g)) - ball.radius - random.in(1e-6, 1);
    const Real h = n.cast<Real>().dot(at(ball, g, from)) - Real(offset) - Real(ball.radius),
               v = n.cast<Real>().dot(speed(ball, g, from)), a = n.cast<Real>().dot(g.cast<Real>());
    const Real D = v * v - 2 * a * h;
    Real expected = -1;
    if (D > 0 && (v < 0 || a < 0))
      expected = Real(from) + (v < 0 ? 2 * h / (std::sqrt(D) - v) : (v + std::sqrt(D)) / -a);
    if (std::abs(expected - Real(until)) < 1e-9L || std::abs(D) < 1e-6L) continue;
    const BallImpact found = ballPlaneImpact(ball, g, n, offset, from, until);
    const bool meets = expected > 0 && expected < until;
    EXPECT_EQ(found.found == BallImpact::Found::impact, meets) << double(expected);
    if (!meets || found.found != BallImpact::Found::impact) continue;
    ++met;
    EXPECT_TRUE(std::abs(double(Real(found.time) - expected)) <= 5e-16 + 2e-14 / double(std::sqrt(D)));
    EXPECT_TRUE(mayTouch(now(ball, g, from), g, n, offset, from, found.time));
  }
  EXPECT_GT(met, 2000);
}

// A bounce leaves the ball touching: the next impact is the next landing, not this one again.
TEST(BallImpact, TouchingAndPartingIsNone) {
  const Vec3 g(0, 0, -10);
  const FlightPath up{{0, 0, 0.1}, {1, 0, 2}, 0, 0.1}, sliding{{0, 0, 0.1}, {1, 0, 0}, 0, 0.1};
  const BallImpact next = ballPlaneImpact(up, g, Vec3::UnitZ(), 0, 0, 5);
  EXPECT_EQ(next.found, BallImpact::Found::impact);
  EXPECT_TRUE(std::abs(next.time - 0.4) <= 2e-16);
  EXPECT_EQ(ballPlaneImpact(up, Vec3::Zero(), Vec3::UnitZ(), 0, 0, 5).found, BallImpact::Found::none);
  EXPECT_EQ(ballPlaneImpact(sliding, g, Vec3::UnitZ(), 0, 0, 5).found, BallImpact::Found::undecided);
  const FlightPath left{{0, 0, 0}, {-1, 0, 0}, 0, 0.1}, right{{0.2, 0, 0}, {1, 0, 0}, 0, 0.1};
  EXPECT_EQ(ballBallImpact(left, right, g, 0, 5).found, BallImpact::Found::none);
  EXPECT_EQ(ballBallImpact(right, left, g, 0, 5).found, BallImpact::Found::none);
  const FlightPath nearing{{0.2, 0, 0}, {-2, 0, 0}, 0, 0.1};
  EXPECT_EQ(ballBallImpact(left, nearing, g, 0, 5).found, BallImpact::Found::impact);
  EXPECT_EQ(ballBallImpact(left, nearing, g, 0, 5).time, 0);
}

}  // namespace
}  // namespace carom
