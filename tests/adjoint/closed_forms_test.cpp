// SPDX-License-Identifier: MIT
// The closed forms of docs/equations.md section 8 for balls on planes and against each other.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/adjoint/tolerances.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

/// A ball over a floor, y up.
Scene ballOverFloor(double radius, double height, double velocity, double elasticity, double gravity) {
  return makeScene({0, -gravity, 0}, elasticity, 0,
                   {makeBall("ball", radius, {0, height, 0}, {0, velocity, 0}), makePlane("floor", Vec3::UnitY(), 0)});
}

TEST(ClosedForm, OneBounceWithoutGravity) {
  const Motion m = play(ballOverFloor(0.1, 1, -2, 1, 0), 1);
  ASSERT_EQ(m.events.size(), 1u);
  expectEntries(m.stateAt("ball", 1).position, Vec3(0, 1.2, 0), kState, "position");
  const SceneGradient g = gradientOf(m, 0, 1, 1);
  expectEntries(g.bodies[0].position, Vec3(0, -1, 0), kDerivative, "dy/dx0");
  expectEntries(g.bodies[0].velocity, Vec3(0, -1, 0), kDerivative, "dy/dv0");
  expectEntries(g.materials[0].elasticity, 1.1, kDerivative, "dy/de");
  expectEntries(g.bodies[0].size.x(), 2, kDerivative, "dy/dr");
  expectEntries(g.bodies[1].position, Vec3(0, 2, 0), kDerivative, "dy/d(floor)");
  expectEntries(g.bodies[0].mass, 0, kDerivative, "dy/dm");
}

Scene floorAndWall(const Vec3& velocity) {
  Scene s = ballOverFloor(0.1, 1, 0, 0.92, 9.8);
  s.bodies[0].position.x() = -0.5;
  s.bodies[0].velocity = velocity;
  s.bodies.push_back(makePlane("wall", -Vec3::UnitX(), -1.75));
  return s;
}

// x = (w - r) - e (v_x T - (w - r - x0)) with the wall at w.
TEST(ClosedForm, FloorAndWall) {
  const double T = 0.6, e = 0.92;
  const Motion m = play(floorAndWall({5, -5, 0}), T);
  ASSERT_EQ(m.events.size(), 2u);
  expectEntries(m.stateAt("ball", T).position, Vec3(0.868, 1.8011886156577, 0), kState, "position");
  const SceneGradient x = gradientOf(m, 0, T, 0), y = gradientOf(m, 0, T, 1);
  expectEntries(x.bodies[0].velocity, Vec3(-e * T, 0, 0), kDerivative, "dx/dv");
  expectEntries(x.bodies[0].position, Vec3(-e, 0, 0), kDerivative, "dx/dx0");
  expectEntries(x.bodies[0].size.x(), -(1 + e), kDerivative, "dx/dr");
  expectEntries(x.bodies[2].position, Vec3(1 + e, 0, 0), kDerivative, "dx/d(wall)");
  expectEntries(x.materials[0].elasticity, -(5 * T - 2.15), kDerivative, "dx/de");
  expectEntries(y.bodies[0].velocity, Vec3(0, -0.35232000310271, 0), kDerivative, "dy/dv");
}

TEST(ClosedForm, FloorAndWallHitTheirTarget) {
  const Motion m = play(floorAndWall({10.195652173913, -4.0907100910675, 0}), 0.6);
  expectEntries(m.stateAt("ball", 0.6).position, Vec3(-2, 1.5, 0), kState, "position");
}

// Without the impact-time term of 5.2 the position passes the wall unchanged and only the velocity turns round:
// dx/dv = tau - e (T - tau).
TEST(ClosedForm, ImpactTimeTermIsNotSmall) {
  const double T = 0.6, e = 0.92;
  const Motion m = play(floorAndWall({5, -5, 0}), T);
  const double found = gradientOf(m, 0, T, 0).bodies[0].velocity.x();
  const double tau = m.events[static_cast<std::size_t>(*m.findImpact(0, 1, 2))].time;
  const double left_out = tau - e * (T - tau);
  EXPECT_GT(std::abs(found - left_out), 0.5);
  expectEntries(found, left_out - (1 + e) * tau, kDerivative, "with the term, (F+ - C F-) dtau = -(1 + e) v dtau");

  const Motion drop = play(ballOverFloor(0.1, 5.1, 0, 0.8, 9.8), 2.5);
  const SceneGradient g = gradientOf(drop, 0, 2.5, 1);
  const double t1 = drop.events[0].time, rest = 2.5 - t1;
  EXPECT_GT(std::abs(g.bodies[0].position.y() - 1), 0.5) << "dy/dy0";
  EXPECT_GT(std::abs(g.bodies[0].velocity.y() - (t1 - 0.8 * rest)), 0.5) << "dy/dv0";
}

// x2(T) = x1 + v1 T + r1 + r2, whenever the balls meet.
TEST(ClosedForm, TwoEqualElasticBalls) {
  const double T = 1;
  for (const double gap : {1e-6, 0.01, 0.1, 0.35, 0.7, 0.999999}) {
    SCOPED_TRACE(gap);
    const Motion m = play(makeScene(Vec3::Zero(), 1, 0,
                                    {makeBall("first", 0.1, Vec3::Zero(), {0.8, 0, 0}),
                                     makeBall("second", 0.1, {0.2 + gap, 0, 0}, {-0.2, 0, 0})}),
                          T);
    ASSERT_EQ(m.events.size(), 1u);
    expectEntries(m.events[0].time, gap, kState, "impact time");
    expectEntries(m.stateAt("second", T).position, Vec3(1, 0, 0), kState, "x2");
    const SceneGradient g = gradientOf(m, 1, T, 0);
    expectEntries(g.bodies[0].position, Vec3(1, 0, 0), kDerivative, "dx2/dx1");
    expectEntries(g.bodies[1].position, Vec3(0, 0, 0), kDerivative, "dx2/dx2");
    expectEntries(g.bodies[0].velocity, Vec3(T, 0, 0), kDerivative, "dx2/dv1");
    expectEntries(g.bodies[1].velocity, Vec3(0, 0, 0), kDerivative, "dx2/dv2");
    expectEntries(g.bodies[0].size.x(), 1, kDerivative, "dx2/dr1");
    expectEntries(g.bodies[1].size.x(), 1, kDerivative, "dx2/dr2");
  }
}

// A ball of any radius whose lowest point moves as the point does.
TEST(ClosedForm, ManyBounces) {
  for (const double r : {0.01, 0.1, 1.0}) {
    const Motion m = play(ballOverFloor(r, 50 + r, 0, 0.8, 9.8), 15);
    ASSERT_EQ(m.events.size(), 3u);
    expectEntries(m.stateAt("ball", 15).position.y() - r, 8.494217007606033, kState, "y");
    expectEntries(gradientOf(m, 0, 15, 1).materials[0].elasticity, 314.56883995768555, kDerivative, "dy/de");
  }
}

TEST(ClosedForm, ManyBouncesReachTheirTargetWithAnotherSequence) {
  const Motion m = play(ballOverFloor(0.1, 50.1, 0, 0.9880083920248765, 9.8), 15);
  EXPECT_EQ(m.events.size(), 2u);
  expectEntries(m.stateAt("ball", 15).position.y() - 0.1, 20, kState, "y");
}

TEST(ClosedForm, PointBall) {
  for (const double r : {0.01, 0.1, 1.0}) {
    const Motion m = play(ballOverFloor(r, 5 + r, 0, 0.8, 9.8), 2.5);
    expectEntries(m.stateAt("ball", 2.5).position.y() - r, 0.922727214752494, kState, "y");
    const SceneGradient g = gradientOf(m, 0, 2.5, 1);
    const Eigen::Vector4d found(g.bodies[0].position.y(), g.bodies[0].velocity.y(), -g.gravity.y(),
                                g.materials[0].elasticity);
    const Eigen::Vector4d expected(1.854772721475249, 0.6817254198060207, -0.8521567747575258, 14.74873734152916);
    expectEntries(found, expected, kDerivative, "dy/d(y0, v0, g, e)");
  }
}

// t_n = t_1 (1 + 2 sum e^k), t_1 = sqrt(2 h/g).
TEST(ClosedForm, BounceTimes) {
  const double h = 2, g = 9.81, e = 0.7, t1 = std::sqrt(2 * h / g);
  const Motion m = play(ballOverFloor(0.1, h + 0.1, 0, e, g), 3.4);
  ASSERT_GE(m.events.size(), 8u);
  DerivativeTape tape(m);
  double sum = 1, dsum = 0, power = 1;  // power = e^(n-1)
  for (int n = 1; n <= static_cast<int>(m.events.size()); ++n) {
    SCOPED_TRACE(n);
    expectEntries(m.events[static_cast<std::size_t>(n - 1)].time, t1 * sum, kState, "t_n");
    StateSeed seed;
    seed.body = 0, seed.at = Instant::before(*m.findImpact(0, n)), seed.time = 1;
    const SceneGradient d = adjoint(tape, std::span(&seed, 1));
    expectEntries(d.bodies[0].position.y(), t1 * sum / (2 * h), kDerivative, "dt_n/dh");
    expectEntries(d.gravity.y(), t1 * sum / (2 * g), kDerivative, "-dt_n/dg");
    expectEntries(d.materials[0].elasticity, t1 * dsum, kDerivative, "dt_n/de");
    dsum += 2 * n * power;
    power *= e;
    sum += 2 * power;
  }
}

}  // namespace
}  // namespace carom
