// SPDX-License-Identifier: MIT
// Bodies that rest on each other on what moves: lifts, belts, turntables, tilting plates. Expected values are closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/motion/lasting_contact.h"
#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::carried_components {
namespace {

using namespace test;

constexpr double kG = 9.81;
const Vec3 kDown(0, 0, -kG);

Body kinematicPlate(const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  Body plate = makeBox("plate", {4, 4, 0.2}, {0, 0, -0.1}, velocity);
  plate.kinematic = true;
  plate.mass.reset();
  plate.angular_velocity = spin;
  return plate;
}

Body beltAt(const Vec3& velocity) {
  Body belt = fixedBody(makeBox("belt", {4, 4, 0.2}, {0, 0, -0.1}));
  belt.surface_velocity = velocity;
  return belt;
}

// A box on a box on what moves, which goes with it.
Scene twoOn(const Body& support, double elasticity = 0, double friction = 0.4) {
  Scene scene = makeScene(kDown, elasticity, friction, {support, makeBox("low", {0.4, 0.4, 0.2}, {0.1, 0, 0.1}), makeBox("high", {0.3, 0.3, 0.2}, {0.2, 0.05, 0.3})});
  for (std::size_t b = 1; b < scene.bodies.size(); ++b) {
    Body& body = scene.bodies[b];
    body.velocity = support.fixed ? support.surface_velocity : Vec3(support.velocity + support.angular_velocity.cross(Vec3(body.position - support.position)));
    body.angular_velocity = support.angular_velocity;
  }
  return scene;
}

Scene inOrder(Scene scene, bool reverse) {
  if (reverse) std::ranges::reverse(scene.bodies);
  return scene;
}

ArcKind lastKind(const Motion& m, int body) { return m.world_lines[static_cast<std::size_t>(body)].arcs.back().kind(); }

const BodyDerivative& of(const Scene& scene, const SceneGradient& g, const char* body) {
  return g.bodies[static_cast<std::size_t>(bodyIndex(scene, body))];
}

TEST(CarriedComponents, TwoBoxesRideALift) {
  const Vec3 V(0.3, -0.2, 1.1);
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(twoOn(kinematicPlate(V)), reverse);
    const Motion m = playLasting(scene, 60);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    for (const char* name : {"low", "high"}) {
      const int body = bodyIndex(scene, name);
      EXPECT_EQ(lastKind(m, body), ArcKind::ride);
      expectEntries(m.stateAt(body, 60).position, Vec3(scene.bodies[static_cast<std::size_t>(body)].position + 60 * V), 1e-13, name);
      expectEntries(m.stateAt(body, 60).velocity, V, 1e-15, name);
      for (int i = 0; i < 3; ++i) {
        const SceneGradient d = gradientOf(m, body, 60, i);
        expectEntries(of(scene, d, "plate").velocity, Vec3(60 * Vec3::Unit(i)), 1e-12, "by the velocity of the lift");
        expectEntries(of(scene, d, name).velocity, Vec3::Zero(), 1e-13, "by its own");
        expectEntries(of(scene, d, "plate").position[i], i == 2 ? 1 : 0, 1e-13, "by the place of the lift");
        expectEntries(of(scene, d, name).position[i], i == 2 ? 0 : 1, 1e-13, "by its own");
      }
      expectEntries(of(scene, gradientOf(m, body, 60, 2), "low").size.z(), name == std::string("low") ? 0.5 : 1, 1e-13, "by the height of the lower box");
    }
    const std::vector<LastingContact> lasting = lastingContacts(m);
    ASSERT_EQ(lasting.size(), 2u);
    for (const LastingContact& c : lasting) EXPECT_EQ(c.kind, ArcKind::ride);
    expectTransposed(m, 1);
  }
}

// r turns about the axis at Omega: d/dOmega is T across it.
TEST(CarriedComponents, TwoBoxesRideATurntableThatRises) {
  const double omega = 1.5, T = 7;
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(twoOn(kinematicPlate({0, 0, 0.5}, {0, 0, omega})), reverse);
    const Motion m = playLasting(scene, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    const int high = bodyIndex(scene, "high");
    EXPECT_EQ(lastKind(m, high), ArcKind::ride);
    const Vec3 at = Eigen::AngleAxisd(omega * T, Vec3::UnitZ()) * Vec3(0.2, 0.05, 0), across = Vec3::UnitZ().cross(at);
    expectEntries(m.stateAt(high, T).position, Vec3(at + Vec3(0, 0, 0.3 + 0.5 * T)), 1e-13, "place");
    expectEntries(m.stateAt(high, T).velocity, Vec3(omega * across + Vec3(0, 0, 0.5)), 1e-13, "velocity");
    expectEntries(m.stateAt(high, T).angular_velocity, Vec3(0, 0, omega), 1e-13, "spin");
    for (int i = 0; i < 2; ++i) {
      const SceneGradient d = gradientOf(m, high, T, i);
      expectEntries(of(scene, d, "plate").angular_velocity.z(), T * across[i], 1e-12, "by the spin");
      expectEntries(of(scene, d, "plate").velocity[i], T, 1e-12, "by the velocity");
    }
    expectTransposed(m, 2);
  }
}

// What falls on a box that a belt carries: without rebound the three go on together, the belt's end is 2 m away.
TEST(CarriedComponents, ABoxFallsOnOneThatABeltCarries) {
  const Vec3 V(0.5, 0.2, 0);
  const double fall = std::sqrt(2 * 0.3 / kG), end = (2 - 0.3) / 0.5;
  for (const bool reverse : {false, true}) {
    Scene scene = inOrder(twoOn(beltAt(V)), reverse);
    const int high = bodyIndex(scene, "high");
    scene.bodies[static_cast<std::size_t>(high)].position.z() += 0.3;
    const Motion m = playLasting(scene, 3);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    expectEntries(m.events.back().time, fall, 1e-14, "meets");
    EXPECT_EQ(lastKind(m, high), ArcKind::ride);
    expectEntries(m.stateAt(high, 3).position, Vec3(Vec3(0.2, 0.05, 0.3) + 3 * V), 1e-13, "place");
    for (int i = 0; i < 2; ++i) {
      const SceneGradient d = gradientOf(m, high, 3, i);
      expectEntries(of(scene, d, "belt").surface_velocity[i], 3 - fall, 1e-11, "by the belt's velocity");
      expectEntries(of(scene, d, "high").velocity[i], fall, 1e-11, "by its own");
      expectEntries(of(scene, d, "high").position[i], 1, 1e-11, "by its place");
    }
    const SceneGradient d = gradientOf(m, high, 3, 0);
    expectEntries(of(scene, d, "high").position.z(), 0, 1e-11, "by its height");
    expectTransposed(m, 3);
    const Motion later = playLasting(scene, 5);
    EXPECT_EQ(later.status, MotionStatus::unresolved_contact);
    expectEntries(later.end, end, 1e-14, "its front reaches the end of the belt");
    EXPECT_NE(later.message.find("where they come to its end"), std::string::npos) << later.message;
  }
}

// A plate tilts about y: in its frame g s - w^2 x pulls along it, and the upper box slips where that is mu of what presses.
TEST(CarriedComponents, ATiltingPlateHoldsThemAsLongAsFrictionDoes) {
  const double w = 0.5, mu = 0.4, x = 0.2, z = 0.4;
  const double slips = (std::atan(mu) - std::asin(w * w * (x + mu * z) / kG / std::hypot(1, mu))) / w;
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(twoOn(kinematicPlate(Vec3::Zero(), {0, w, 0}), 0, mu), reverse);
    const Motion m = playLasting(scene, 2);
    EXPECT_EQ(m.status, MotionStatus::unresolved_contact) << m.message;
    EXPECT_NE(m.message.find("no longer holds them"), std::string::npos) << m.message;
    // what lacks 1e-9 of the weights at each of four corners counts as held: 4e-9 mu / (w (1 + mu^2)) s
    expectEntries(m.end, slips, 1e-8, "slips");
    const int high = bodyIndex(scene, "high");
    const Vec3 at = Eigen::AngleAxisd(w * 0.7, Vec3::UnitY()) * Vec3(x, 0.05, z);
    expectEntries(m.stateAt(high, 0.7).position, Vec3(at - Vec3(0, 0, 0.1)), 1e-13, "place");
    expectTransposed(playLasting(scene, 0.7), 4);
  }
}

// Two balls knock the upper box off from below: what is left alone rides to its own limit, g s - w^2 x at mu of what presses, and
// slides from there.
TEST(CarriedComponents, WhatIsLeftAloneGoesOnByItself) {
  const double w = 0.3, mu = 0.4, z = 0.2;
  Scene scene = twoOn(kinematicPlate(Vec3::Zero(), {0, w, 0}), 0, mu);
  scene.bodies[1].position.x() = scene.bodies[2].position.x() = 0;
  std::get<Box>(scene.bodies[2].shape).size.y() = 1.4;
  scene.bodies[1].mass = 10, scene.bodies[2].mass = 0.2;
  for (std::size_t b = 1; b < 3; ++b) scene.bodies[b].velocity = Vec3(0, w, 0).cross(Vec3(scene.bodies[b].position - scene.bodies[0].position));
  for (const double side : {-0.6, 0.6}) scene.bodies.push_back(makeBall(side < 0 ? "left" : "right", 0.05, {0, side, 0.1}, {0.03, 0, 9}));
  scene.bodies[3].mass = scene.bodies[4].mass = 1;
  const Motion m = playLasting(scene, 1.4);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_GT(m.stateAt(2, m.end).position.z(), 0.5);
  EXPECT_EQ(lastKind(m, 1), ArcKind::slide);
  expectEntries(m.world_lines[1].arcs.back().start(), (std::atan(mu) - std::asin(w * w * mu * z / kG / std::hypot(1, mu))) / w, 1e-12, "slips");
}

// Round and round, where friction is enough all the way: the tilt of the table against gravity turns with it.
TEST(CarriedComponents, ATableThatIsNotLevelTurnsForEver) {
  Scene scene = twoOn(kinematicPlate(Vec3::Zero(), {0, 0, 2}), 0, 0.5);
  scene.gravity = kG * Vec3(std::sin(0.3), 0, -std::cos(0.3));
  const Motion m = playLasting(scene, 30);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_EQ(lastKind(m, 2), ArcKind::ride);
  scene.gravity = kG * Vec3(std::sin(0.47), 0, -std::cos(0.47));  // tan 0.47 = 0.508
  EXPECT_EQ(playLasting(scene, 30).status, MotionStatus::unresolved_contact);
}

// A ball that bounces on what a lift carries sees a floor that rises: what lies there keeps its arcs.
TEST(CarriedComponents, WhatBouncesOnThemLeavesThem) {
  for (const bool reverse : {false, true}) {
    Scene scene = twoOn(kinematicPlate({0.1, 0, 0.8}), 0.6);
    scene.bodies.push_back(makeBall("ball", 0.1, {0.2, 0.05, 1.5}, {0.1, 0, 0}));
    scene = inOrder(scene, reverse);
    const int ball = bodyIndex(scene, "ball"), high = bodyIndex(scene, "high");
    const Motion m = playLasting(scene, 6);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.world_lines[static_cast<std::size_t>(high)].arcs.size(), 2u);
    EXPECT_EQ(lastKind(m, ball), ArcKind::ride);
    const double meets = (std::sqrt(0.64 + 2 * kG) - 0.8) / kG;
    expectEntries(m.events[1].time, meets, 1e-14, "first bounce");
    expectEntries(m.stateAt(ball, 6).position, Vec3(0.8, 0.05, 0.5 + 0.8 * 6), 1e-12, "place");
    const SceneGradient d = gradientOf(m, ball, 6, 2);
    expectEntries(of(scene, d, "plate").velocity.z(), 6, 1e-11, "by the lift's velocity");
    expectEntries(of(scene, d, "low").size.z(), 1, 1e-11, "by the height of the lower box");
    expectTransposed(m, 5, 1e-11);
  }
}

TEST(CarriedComponents, AReplayFollowsThem) {
  const double h = 1e-3, T = 3;
  const Scene scene = twoOn(kinematicPlate({0, 0, 0.5}, {0, 0, 1.5}));
  const Motion m = playLasting(scene, T);
  Scene faster = scene;
  faster.bodies[0].angular_velocity.z() += h;
  const MotionAlong along = simulateAlong(m, faster, m.geometry, T);
  ASSERT_TRUE(along.complete) << along.why_not;
  const Vec3 at = Eigen::AngleAxisd((1.5 + h) * T, Vec3::UnitZ()) * Vec3(0.2, 0.05, 0);
  expectEntries(along.motion.stateAt(2, T).position, Vec3(at + Vec3(0, 0, 0.3 + 0.5 * T)), 1e-13, "place");
}

// Two lifts of other speeds, a lift that turns and is a belt: no one motion carries them.
TEST(CarriedComponents, WhatNoOneMotionCarriesEndsIt) {
  const auto plateAt = [](const char* name, double x, const Vec3& velocity) {
    Body plate = kinematicPlate(velocity);
    plate.name = name, plate.position.x() = x;
    std::get<Box>(plate.shape).size.x() = 0.3;
    return plate;
  };
  Scene two = makeScene(kDown, 0, 0.4, {plateAt("left", -0.5, {0, 0, 1}), plateAt("right", 0.5, {0, 0.1, 1}), makeBox("low", {1.3, 0.4, 0.2}, {0, 0, 0.1}, {0, 0, 1}),
                                        makeBox("high", {0.3, 0.3, 0.2}, {0, 0, 0.3}, {0, 0, 1})});
  EXPECT_EQ(playLasting(two, 1).status, MotionStatus::unresolved_contact);
  Body both = kinematicPlate({0, 0, 1}, {0, 0, 0.1});
  both.surface_velocity = {0.2, 0, 0};
  EXPECT_EQ(playLasting(twoOn(both), 1).status, MotionStatus::unresolved_contact);
}

}  // namespace
}  // namespace carom::carried_components
