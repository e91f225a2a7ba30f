// SPDX-License-Identifier: MIT
// Components on all kinds of carriers: surfaces that run and turn, on bodies that move, several that move alike; and what comes
// where they end. Expected values are closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/derivative_tape.h"  // Reliability
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::carrier_kinds {
namespace {

using namespace test;

constexpr double kG = 9.81;
const Vec3 kDown(0, 0, -kG), kUp = Vec3::UnitZ();

// Its top is at height 0.
Body plate(const char* name, const Vec3& at, double length) { return fixedBody(makeBox(name, {length, 4, 0.2}, at - Vec3(0, 0, 0.1))); }

Body lift(Body body, const Vec3& velocity) {
  body.fixed = false, body.kinematic = true, body.mass.reset();
  body.velocity = velocity;
  return body;
}

// On supports, a box and one on it, with velocities v + w x (place - center).
Scene twoOn(std::vector<Body> supports, const Vec3& at, const Vec3& v, const Vec3& w = Vec3::Zero(), const Vec3& center = Vec3::Zero(), double length = 0.4,
            double friction = 0.4) {
  supports.push_back(makeBox("low", {length, 0.4, 0.2}, at + Vec3(0, 0, 0.1)));
  supports.push_back(makeBox("high", {0.3, 0.3, 0.2}, at + Vec3(0.05, 0.02, 0.3)));
  for (std::size_t b = supports.size() - 2; b < supports.size(); ++b) {
    supports[b].velocity = v + w.cross(Vec3(supports[b].position - center));
    supports[b].angular_velocity = w;
  }
  return makeScene(kDown, 0, friction, std::move(supports));
}

Scene inOrder(Scene scene, bool reverse) {
  if (reverse) std::ranges::reverse(scene.bodies);
  return scene;
}

const BodyDerivative& of(const Scene& scene, const SceneGradient& g, const char* body) {
  return g.bodies[static_cast<std::size_t>(bodyIndex(scene, body))];
}
Vec3 placeIn(const Scene& scene, const char* body) { return scene.bodies[static_cast<std::size_t>(bodyIndex(scene, body))].position; }
ArcKind lastKind(const Motion& m, int body) { return m.world_lines[static_cast<std::size_t>(body)].arcs.back().kind(); }

TEST(CarrierKinds, ALiftWithABelt) {
  const Vec3 V(0.1, 0, 0.5), belt(0.2, -0.1, 0);
  const double T = 5;
  for (const bool reverse : {false, true}) {
    Body on = lift(plate("lift", Vec3::Zero(), 4), V);
    on.surface_velocity = belt;
    const Scene scene = inOrder(twoOn({on}, Vec3::Zero(), V + belt), reverse);
    const Motion m = playLasting(scene, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    const int high = bodyIndex(scene, "high");
    EXPECT_EQ(lastKind(m, high), ArcKind::ride);
    expectEntries(m.stateAt(high, T).position, Vec3(placeIn(scene, "high") + T * (V + belt)), 1e-13, "place");
    for (int i = 0; i < 3; ++i) {
      const SceneGradient d = gradientOf(m, high, T, i);
      expectEntries(of(scene, d, "lift").velocity, Vec3(T * Vec3::Unit(i)), 1e-12, "by the lift's velocity");
      expectEntries(of(scene, d, "lift").surface_velocity, Vec3(i < 2 ? T * Vec3::Unit(i) : Vec3::Zero()), 1e-12, "by the belt's");
      // the face turns: what lies on it goes T^2 W x belt further across, and with it
      const Vec3 at = m.stateAt(high, T).position - T * V - Vec3(0, 0, -0.1);
      expectEntries(of(scene, d, "lift").angular_velocity, Vec3(T * at.cross(Vec3::Unit(i))), 1e-11, "by its angular velocity");
    }
    expectTransposed(m, 1, 1e-12);
  }
}

// About the centre where the material stands: o + n x u/Omega.
TEST(CarrierKinds, ASurfaceThatTurnsAndRuns) {
  const double omega = 0.8, T = 4;
  const Vec3 u(0.3, -0.2, 0), o(0.2, 0.1, 0), center = o + kUp.cross(u) / omega;
  for (const bool reverse : {false, true}) {
    Body table = plate("table", o, 6);
    table.surface_velocity = u, table.surface_angular_velocity = {0, 0, omega};
    const Scene scene = inOrder(twoOn({table}, {0.3, 0.1, 0}, Vec3::Zero(), {0, 0, omega}, center), reverse);
    const Motion m = playLasting(scene, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    const int high = bodyIndex(scene, "high");
    const Mat3 E = Eigen::AngleAxisd(omega * T, kUp).toRotationMatrix();
    const Vec3 from = placeIn(scene, "high") - center, level = from - kUp * from.z(), at = E * level;
    expectEntries(m.stateAt(high, T).position, Vec3(center + E * from), 1e-13, "place");
    expectEntries(m.stateAt(high, T).angular_velocity, Vec3(0, 0, omega), 1e-13, "spin");
    const Vec3 dcenter = -kUp.cross(u) / (omega * omega);
    for (int i = 0; i < 2; ++i) {
      const SceneGradient d = gradientOf(m, high, T, i);
      const Vec3 by_spin = T * kUp.cross(at) + (Mat3::Identity() - E) * dcenter;
      expectEntries(of(scene, d, "table").surface_angular_velocity.z(), by_spin[i], 1e-12, "by the turn");
      for (int j = 0; j < 2; ++j) {
        const Vec3 by_velocity = (Mat3::Identity() - E) * kUp.cross(Vec3::Unit(j)) / omega;
        expectEntries(of(scene, d, "table").surface_velocity[j], by_velocity[i], 1e-12, "by its velocity");
        expectEntries(of(scene, d, "table").position[j], Mat3(Mat3::Identity() - E)(i, j), 1e-12, "by its place");
        expectEntries(of(scene, d, "high").position[j], E(i, j), 1e-12, "by its own");
      }
    }
    expectTransposed(m, 2, 1e-12);
  }
}

// Nearly straight: the same to what a turn of 1e-9 rad/s makes.
TEST(CarrierKinds, ATurnThatIsNextToNoneIsNoJump) {
  Body straight = plate("table", Vec3::Zero(), 6), turning = straight;
  straight.surface_velocity = turning.surface_velocity = {0.3, 0, 0};
  turning.surface_angular_velocity = {0, 0, 1e-9};
  const Scene a = twoOn({straight}, Vec3::Zero(), {0.3, 0, 0}), b = twoOn({turning}, Vec3::Zero(), {0.3, 0, 0}, {0, 0, 1e-9});
  const Motion of_a = playLasting(a, 4), of_b = playLasting(b, 4);
  ASSERT_EQ(of_a.status, MotionStatus::complete) << of_a.message;
  ASSERT_EQ(of_b.status, MotionStatus::complete) << of_b.message;
  expectEntries(of_b.stateAt(2, 4).position, of_a.stateAt(2, 4).position, 1e-8, "place");
  for (int i = 0; i < 3; ++i) {
    const BodyDerivative c = gradientOf(of_a, 2, 4, i).bodies[0], d = gradientOf(of_b, 2, 4, i).bodies[0];
    expectEntries(d.surface_angular_velocity, c.surface_angular_velocity, 1e-7, "by the turn");
    expectEntries(d.surface_velocity, c.surface_velocity, 1e-7, "by the velocity");
  }
  // y = T (x + u T/2) by the turn, and the height of the face over the origin, 0.1, by that about y
  expectEntries(gradientOf(of_a, 2, 4, 1).bodies[0].surface_angular_velocity.z(), 4 * (0.05 + 0.6), 1e-12, "by the turn");
  expectEntries(gradientOf(of_a, 2, 4, 0).bodies[0].surface_angular_velocity.y(), 4 * 0.1, 1e-12, "about y");
}

// A disc that turns about its axis carries for ever; of a square, a corner of the box comes to its side.
TEST(CarrierKinds, TheyComeToTheSideOfATurntable) {
  const double omega = 0.7, at = 0.55;
  Body disc = plate("table", Vec3::Zero(), 2), square = plate("table", Vec3::Zero(), 2);
  disc.shape = Cylinder{1, 0.2};
  std::get<Box>(square.shape).size.y() = 1.4;
  disc.surface_angular_velocity = square.surface_angular_velocity = {0, 0, omega};
  for (const bool reverse : {false, true}) {
    const Motion m = playLasting(inOrder(twoOn({disc}, {at, 0, 0}, Vec3::Zero(), {0, 0, omega}), reverse), 30);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.events.size(), 1u);
    const Motion over = playLasting(inOrder(twoOn({square}, {at, 0, 0}, Vec3::Zero(), {0, 0, omega}), reverse), 30);
    EXPECT_EQ(over.status, MotionStatus::unresolved_contact);
    // the corner at (0.75, 0.2), that turns to y = 0.7 at r
    const double r = std::hypot(at + 0.2, 0.2);
    expectEntries(over.end, (std::asin(0.7 / r) - std::atan2(0.2, at + 0.2)) / omega, 1e-13, "its corner comes there");
    EXPECT_NE(over.message.find("where they come to its end"), std::string::npos) << over.message;
  }
}

TEST(CarrierKinds, TwoLiftsThatRiseAlike) {
  const Vec3 V(0, 0.1, 1);
  const double T = 3;
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(twoOn({lift(plate("left", {-0.5, 0, 0}, 0.3), V), lift(plate("right", {0.5, 0, 0}, 0.3), V)}, Vec3::Zero(), V, Vec3::Zero(), Vec3::Zero(), 1.4), reverse);
    const Motion m = playLasting(scene, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    const int high = bodyIndex(scene, "high");
    expectEntries(m.stateAt(high, T).position, Vec3(placeIn(scene, "high") + T * V), 1e-13, "place");
    Reliability reliability;
    const SceneGradient d = adjoint(m, std::vector{seedOf(high, Instant::at(T), 2)}, &reliability);
    expectEntries(of(scene, d, "left").velocity.z() + of(scene, d, "right").velocity.z(), T, 1e-12, "by that of both");
    EXPECT_TRUE(reliability.reliable) << reliability.message;
    reliability.askVelocity(bodyIndex(scene, "left"));
    EXPECT_FALSE(reliability.reliable);
    EXPECT_NE(reliability.message.find("move alike"), std::string::npos) << reliability.message;
    expectTransposed(m, 3, 1e-12);
  }
  Scene apart = twoOn({lift(plate("left", {-0.5, 0, 0}, 0.3), V), lift(plate("right", {0.5, 0, 0}, 0.3), V + Vec3(0, 1e-9, 0))}, Vec3::Zero(), V, Vec3::Zero(), Vec3::Zero(), 1.4);
  EXPECT_EQ(playLasting(apart, T).status, MotionStatus::unresolved_contact);
}

// Over a joint of two belts of one speed, and to the end of the second.
TEST(CarrierKinds, TwoBeltsOfOneSpeed) {
  const double v = 0.5, x = -0.6;
  for (const bool reverse : {false, true}) {
    Body first = plate("first", {-2, 0, 0}, 4), second = plate("second", {1, 0, 0}, 2);
    first.surface_velocity = second.surface_velocity = {v, 0, 0};
    const Scene scene = inOrder(twoOn({first, second}, {x, 0, 0}, {v, 0, 0}), reverse);
    const Motion m = playLasting(scene, 4);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    for (const char* name : {"low", "high"}) {
      const int body = bodyIndex(scene, name);
      EXPECT_EQ(lastKind(m, body), ArcKind::ride);
      expectEntries(m.stateAt(body, 4).position, Vec3(placeIn(scene, name) + Vec3(4 * v, 0, 0)), 1e-13, name);
      Reliability reliability;
      const SceneGradient d = adjoint(m, std::vector{seedOf(body, Instant::at(4), 0)}, &reliability);
      EXPECT_TRUE(reliability.reliable) << reliability.message;
      reliability.askSurface(bodyIndex(scene, "first"));
      EXPECT_FALSE(reliability.reliable);
      expectEntries(of(scene, d, "first").surface_velocity.x() + of(scene, d, "second").surface_velocity.x(), 4, 1e-12, "by that of both");
      expectEntries(of(scene, d, name).position.x(), 1, 1e-12, "by its place");
    }
    expectTransposed(m, 4, 1e-12);
    const Motion over = playLasting(scene, 6);
    EXPECT_EQ(over.status, MotionStatus::unresolved_contact);
    expectEntries(over.end, (2 - 0.2 - x) / v, 1e-13, "its front comes to the end of the second");
  }
}

// The second is a floor, or another speed: what rests on another body would slide.
TEST(CarrierKinds, ANextBeltOfAnotherSpeedEndsTheRide) {
  for (const double other : {0.0, 0.3})
    for (const bool reverse : {false, true}) {
      Body first = plate("first", {-2, 0, 0}, 4), second = plate("second", {1, 0, 0}, 2);
      first.surface_velocity = {0.5, 0, 0}, second.surface_velocity = {other, 0, 0};
      const Motion m = playLasting(inOrder(twoOn({first, second}, {-0.6, 0, 0}, {0.5, 0, 0}), reverse), 4);
      EXPECT_EQ(m.status, MotionStatus::unresolved_contact);
      expectEntries(m.end, 0.4 / 0.5, 1e-13, "its front comes to the second");
      EXPECT_NE(m.message.find(reverse ? "'high' and 'low'" : "'low' and 'high'"), std::string::npos) << m.message;
    }
}

}  // namespace
}  // namespace carom::carrier_kinds
