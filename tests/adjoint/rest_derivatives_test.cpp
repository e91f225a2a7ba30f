// SPDX-License-Identifier: MIT
// What rests or rolls, and would roll on or away if it were struck a little differently: closed forms, both passes, bodies in
// reverse order; and what nothing holds, of which no such form is known, is marked.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::rest_derivatives {
namespace {

using namespace test;

constexpr double kUntil = 2;  // s

Body lyingCylinder(const Vec3& position) {
  Body body = makeBall("body", 0.1, position);
  body.shape = Cylinder{0.1, 0.3};
  body.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX());  // its axis along y
  return body;
}

// d(place at the end)/d(velocity along x), d(velocity at the end)/d(spin about y).
void expectRolls(Scene scene, double by_velocity, double by_spin) {
  for (const bool reverse : {false, true}) {
    if (reverse) std::reverse(scene.bodies.begin(), scene.bodies.end());
    const Motion m = playLasting(scene, kUntil);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const int body = reverse ? 1 : 0;
    DerivativeTape tape(m);
    SceneTangent v(scene), w(scene);
    v.bodies[static_cast<std::size_t>(body)].velocity = Vec3::UnitX();
    w.bodies[static_cast<std::size_t>(body)].angular_velocity = Vec3::UnitY();
    EXPECT_NEAR(tangent(tape, v).at(body, Instant::at(kUntil)).position.x(), by_velocity, 1e-13 * kUntil);
    EXPECT_NEAR(tangent(tape, w).at(body, Instant::at(kUntil)).position.x(), by_spin, 1e-13 * kUntil);
    StateSeed seed;
    seed.body = body, seed.at = Instant::at(kUntil), seed.position = Vec3::UnitX();
    Reliability reliability;
    const SceneGradient gradient = adjoint(tape, std::span(&seed, 1), &reliability);
    EXPECT_NEAR(gradient.bodies[static_cast<std::size_t>(body)].velocity.x(), by_velocity, 1e-13 * kUntil);
    EXPECT_NEAR(gradient.bodies[static_cast<std::size_t>(body)].angular_velocity.y(), by_spin, 1e-13 * kUntil);
    reliability.askVelocity(body);
    const bool joint = reliability.message.find("joins several contacts") != std::string::npos;  // of a line, which says so
    EXPECT_TRUE(reliability.reliable || joint) << reliability.message;
    expectTransposed(m, 5, 1e-12);
  }
}

// k = I/(m r^2): what is given to the velocity is shared, 1 : k, with the spin.
void expectRollsAway(const Body& body, double k) {
  const double share = 1 / (1 + k), r = 0.1;
  Body at_rest = body, rolling = body, above = body;
  at_rest.position.z() = r;
  rolling.position.z() = r, rolling.velocity = {1, 0, 0}, rolling.angular_velocity = {0, 1 / r, 0};
  above.position.z() = 0.5;
  const double fall = std::sqrt(2 * (0.5 - r) / 9.81);
  for (const Body& b : {at_rest, rolling}) expectRolls(makeScene({0, 0, -9.81}, 0, 0.3, {b, makePlane("floor", Vec3::UnitZ(), 0)}), share * kUntil, share * k * r * kUntil);
  expectRolls(makeScene({0, 0, -9.81}, 0, 0.3, {above, makePlane("floor", Vec3::UnitZ(), 0)}), fall + share * (kUntil - fall), share * k * r * (kUntil - fall));
}

TEST(RestDerivatives, ABallThatLiesStillOrRollsOrFallsStraightDownRollsAway) { expectRollsAway(makeBall("body", 0.1, {0, 0, 0}), 0.4); }

TEST(RestDerivatives, SoDoesACylinderOnItsSide) { expectRollsAway(lyingCylinder({0, 0, 0}), 0.5); }

// The limits of what slips at first and rolls then, from both sides.
TEST(RestDerivatives, AreLimitsOfSlips) {
  for (const Body& body : {makeBall("body", 0.1, {0, 0, 0.1}), lyingCylinder({0, 0, 0.1})}) {
    Scene scene = makeScene({0, 0, -9.81}, 0, 0.3, {body, makePlane("floor", Vec3::UnitZ(), 0)});
    const Motion m = playLasting(scene, kUntil);
    DerivativeTape tape(m);
    SceneTangent d(scene);
    d.bodies[0].velocity = {0.7, 0, 0}, d.bodies[0].angular_velocity = {0, -1.3, 0};
    const BodyStateRate found = tangent(tape, d).at(0, Instant::at(kUntil));
    for (const double h : {1e-6, -1e-6}) {
      const BodyState s = playLasting(moved(scene, d, h), kUntil).stateAt(0, kUntil);
      EXPECT_NEAR((s.position - m.stateAt(0, kUntil).position).x() / h, found.position.x(), 1e-5);
      EXPECT_NEAR(s.angular_velocity.y() / h, found.angular_velocity.y(), 1e-5);
    }
  }
}

Reliability reliabilityAtEnd(const Scene& scene, bool velocity) {
  const Motion m = playLasting(scene, kUntil);
  EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::rest);
  StateSeed seed;
  seed.body = 0, seed.at = Instant::at(kUntil), seed.position = {1, 0.5, -1};
  Reliability reliability;
  adjoint(m, std::span(&seed, 1), &reliability);
  if (velocity) reliability.askVelocity(0);
  return reliability;
}

// Without friction, or in a groove along which it may roll, a body rests and nothing holds it; a box on a floor is held.
TEST(RestDerivatives, OfWhatNothingHoldsAreMarked) {
  const Scene held = makeScene({0, 0, -9.81}, 0, 0.3, {makeBox("body", {0.2, 0.2, 0.2}, {0, 0, 0.1}), makePlane("floor", Vec3::UnitZ(), 0)});
  EXPECT_TRUE(reliabilityAtEnd(held, true).reliable);
  Scene smooth = held;
  smooth.materials[0].friction = 0;
  EXPECT_TRUE(reliabilityAtEnd(smooth, false).reliable);
  EXPECT_FALSE(reliabilityAtEnd(smooth, true).reliable);
  const double r = 0.1;
  const Scene groove = makeScene({0, 0, -9.81}, 0, 0.3, {makeBall("body", r, {0, 0, std::sqrt(2) * r}), makePlane("left", Vec3(1, 0, 1).normalized(), 0),
                                                          makePlane("right", Vec3(-1, 0, 1).normalized(), 0)});
  EXPECT_FALSE(reliabilityAtEnd(groove, true).reliable);
  Scene dropped = groove;
  dropped.bodies[0].position.z() = 0.5;
  const Reliability reliability = reliabilityAtEnd(dropped, false);
  EXPECT_FALSE(reliability.reliable);
}

}  // namespace
}  // namespace carom::rest_derivatives
