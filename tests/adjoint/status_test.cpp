// SPDX-License-Identifier: MIT
// How a motion ends when it cannot go on: a status, a sentence, and never a hang.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

const Vec3 kFreeFall(0, 0, -9.81);

Body floorPlane() { return makePlane("floor", Vec3::UnitZ(), 0); }
Scene droppedBall(double elasticity, double height = 1.1) {
  return makeScene(kFreeFall, elasticity, 0, {makeBall("ball", 0.1, {0, 0, height}), floorPlane()});
}

TEST(Status, Complete) {
  const Motion m = play(droppedBall(0.8), 0.5);
  EXPECT_EQ(m.status, MotionStatus::complete);
  EXPECT_EQ(m.end, 0.5);
  EXPECT_EQ(m.duration, 0.5);
}

TEST(Status, ImpactLimit) {
  const Motion whole = play(droppedBall(0.8), 3), m = play(droppedBall(0.8), 3, 4);
  EXPECT_EQ(m.status, MotionStatus::impact_limit);
  EXPECT_EQ(m.events.size(), 4u);
  EXPECT_NE(m.message.find("4 impacts"), std::string::npos) << m.message;
  expectEntries(m.end, whole.events[4].time, 1e-13, "the motion is known up to the impact that was not allowed");
  EXPECT_NO_THROW(m.stateAt("ball", m.end));
  EXPECT_THROW(m.stateAt("ball", 3), InputError);
}

Motion playWithoutLasting(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.lowest_bounce = 0;
  return simulate(scene, contacts, duration, options);
}

// Released from rest the bounces pile up at t_1 (1 + e)/(1 - e). Then the ball rests, where contact lasts.
TEST(Status, CascadeOfABall) {
  for (double e : {0.8, 0.6, 0.3, 0.1})
    for (double height : {0.2, 1.1, 20.1}) {
      SCOPED_TRACE(std::to_string(e) + " from " + std::to_string(height));
      const double t1 = std::sqrt(2 * (height - 0.1) / 9.81), settles = t1 * (1 + e) / (1 - e);
      const Motion m = playWithoutLasting(droppedBall(e, height), 60), rests = play(droppedBall(e, height), 60);
      EXPECT_EQ(m.status, MotionStatus::cascade) << m.message;
      // as its next bounce would stay lower than 1e-12 of its height
      const double left = 2 * std::sqrt(2e-12 * std::max(height, 0.1) / 9.81) / (1 - e);
      EXPECT_TRUE(m.end <= settles + 1e-9 && m.end >= settles - left) << m.end;
      EXPECT_NE(m.message.find("'ball' and 'floor'"), std::string::npos) << m.message;
      EXPECT_TRUE(std::abs(m.stateAt("ball", m.end).position.z() - 0.1) < 1e-9);
      EXPECT_EQ(rests.status, MotionStatus::complete) << rests.message;
      EXPECT_EQ(rests.stateAt("ball", 60).position.z(), 0.1);
      EXPECT_TRUE(rests.stateAt("ball", 60).velocity.isZero(0));
      ASSERT_TRUE(rests.events.back().settles_at.has_value());
      expectEntries(*rests.events.back().settles_at, settles, 1e-11, "settles at");
    }
}

TEST(Status, PlasticLanding) {
  for (double friction : {0.0, 0.4}) {
    Scene s = droppedBall(0);
    s.materials[0].friction = friction;
    const Motion m = play(s, 5), ends = playWithoutLasting(s, 5);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    EXPECT_EQ(m.events[0].kind, EventKind::capture);
    EXPECT_EQ(ends.status, MotionStatus::cascade) << ends.message;
    expectEntries(ends.end, std::sqrt(2 / 9.81), 1e-9, "end");
  }
}

// Everything comes to rest on its face or, if it is a ball, anywhere.
void expectRest(const Scene& s, const char* what) {
  SCOPED_TRACE(what);
  const Motion m = play(s, 100);
  EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_LT(m.events.size(), 5000u);
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b) {
    const BodyState at = m.stateAt(b, 20), end = m.stateAt(b, 100);
    EXPECT_TRUE(end.velocity.isZero(0) && end.angular_velocity.isZero(0)) << s.bodies[static_cast<std::size_t>(b)].name;
    EXPECT_TRUE(at.position == end.position && at.orientation.coeffs() == end.orientation.coeffs());
  }
}

// Contact lasts in a way that is not modelled: that is the answer, soon.
void expectUnresolved(const Scene& s) {
  OdeContacts contacts(s);
  SimulateOptions options;
  options.groups = false;
  const Motion m = simulate(s, contacts, 100, options);
  EXPECT_EQ(m.status, MotionStatus::unresolved_contact) << m.message;
  EXPECT_LT(m.end, 20);
  EXPECT_LT(m.events.size(), 5000u);
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    EXPECT_TRUE(flatten(m.stateAt(b, m.end)).allFinite()) << s.bodies[static_cast<std::size_t>(b)].name;
}

Body tumblingBox() {
  Body b = makeBox("box", {0.3, 0.2, 0.15}, {0, 0, 1}, {0.5, 0.2, -1});
  b.orientation = Quat(0.8, 0.3, -0.4, 0.2).normalized();
  b.angular_velocity = {1, 2, -1};
  return b;
}

TEST(Status, BoxRattlesToRest) {
  for (double e : {0.0, 0.3, 0.6}) {
    const std::string what = "e " + std::to_string(e);
    expectRest(makeScene(kFreeFall, e, 0.5, {tumblingBox(), floorPlane()}), what.c_str());
  }
}

// Without friction it lies flat in the end, slides on as fast as it was thrown, and turns for ever.
TEST(Status, BoxRattlesToAFaceWithoutFriction) {
  for (double e : {0.0, 0.3, 0.6}) {
    SCOPED_TRACE("e " + std::to_string(e));
    const Motion m = play(makeScene(kFreeFall, e, 0, {tumblingBox(), floorPlane()}), 20);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    const BodyState end = m.stateAt(0, 20), before = m.stateAt(0, 15);
    const Vec3 up = (end.orientation.conjugate() * Vec3::UnitZ()).cwiseAbs(), half = 0.5 * Vec3(0.3, 0.2, 0.15);
    expectEntries(up.maxCoeff(), 1, 1e-12, "a face is down");
    expectEntries(end.position.z(), up.dot(half), 1e-12, "height");
    expectEntries(end.velocity, Vec3(0.5, 0.2, 0), 1e-12, "velocity");
    expectEntries(end.angular_velocity, Vec3(0, 0, before.angular_velocity.z()), 1e-12, "angular velocity");
    EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::slide);
  }
}

TEST(Status, BoxDroppedFlatComesToRest) {
  for (double e : {0.0, 0.3})
    expectRest(makeScene(kFreeFall, e, 0.5, {makeBox("box", {0.3, 0.2, 0.15}, {0, 0, 1}, {0.2, 0, 0}), floorPlane()}),
               "flat");
}

TEST(Status, BallInAVComesToRest) {
  const double s = std::sqrt(0.5);
  const auto inAV = [&](double x, double friction) {
    return makeScene(kFreeFall, 0.5, friction,
                     {makeBall("ball", 0.1, {x, 0, 1}), makePlane("left", {s, 0, s}, 0), makePlane("right", {-s, 0, s}, 0)});
  };
  expectRest(inAV(0, 0), "V");
  expectRest(inAV(0, 0.5), "V");
  expectRest(inAV(0.13, 0), "V");
  expectRest(inAV(0.13, 0.5), "V, where it still spins between the two");
}

TEST(Status, AStackEndsWhereItWouldRest) {
  expectUnresolved(makeScene(kFreeFall, 0.3, 0.5,
                          {makeBox("low", {0.4, 0.4, 0.2}, {0, 0, 0.3}),
                           makeBox("high", {0.2, 0.2, 0.2}, {0.05, 0, 0.8}), floorPlane()}));
}

// Bodies that lie on one another from the start are in lasting contact at once.
TEST(Status, RestingFromTheStart) {
  const Body box = makeBox("box", {0.2, 0.3, 0.2}, {0, 0, 0.1});
  for (double e : {0.0, 0.5, 1.0})
    for (const Body& body : {box, makeBall("ball", 0.1, {0, 0, 0.1})}) {
      SCOPED_TRACE(body.name + ", e " + std::to_string(e));
      const Motion m = play(makeScene(kFreeFall, e, 0.3, {body, floorPlane()}), 3);
      EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
      ASSERT_EQ(m.events.size(), 1u);
      EXPECT_EQ(m.events[0].kind, EventKind::placed);
      EXPECT_EQ(m.stateAt(0, 3).position, body.position);
    }
}

// n = z: beta leans the normal towards -x. A ball that skims along +x is then struck from behind.
TEST(Status, TiltThatDoesNotPartTheBodies) {
  Scene s = makeScene(Vec3::Zero(), 0.5, 0, {makeBall("ball", 0.1, {0, 0, 0.2}, {1, 0, -0.1}), floorPlane()});
  s.tilts = {{"ball", 1, {0, -3}}};
  const Motion m = play(s, 3);
  EXPECT_EQ(m.status, MotionStatus::unresolved_impact);
  expectEntries(m.end, 1, 1e-12, "end");
  EXPECT_TRUE(m.events.empty());
  EXPECT_NE(m.message.find("tilted normal at the impact of 'ball' and 'floor'"), std::string::npos) << m.message;
  s.tilts[0].value = {0, 0.1};
  EXPECT_EQ(play(s, 3).status, MotionStatus::complete);
}

TEST(Status, StatesOutsideTheMotionAreRefused) {
  const Motion m = playWithoutLasting(droppedBall(0.5), 60);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (double t : {-1e-300, -1.0, m.end + 1e-9, 60.0, inf, -inf, nan}) {
    try {
      m.stateAt("ball", t);
      ADD_FAILURE() << "no error at " << t;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("expected one in [0, "), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("stay in contact"), std::string::npos) << error.what();
    }
    const StateSeed seed = seedOf(0, Instant::at(t), 0);
    EXPECT_THROW(adjoint(m, std::span(&seed, 1)), InputError) << t;
  }
  EXPECT_THROW(m.stateAt("wall", 0), InputError);
  EXPECT_EQ(m.stateBefore(0, 1).position, m.scene->bodies[1].position) << "the floor has no part as a moving body";
}

TEST(Status, DurationsAreChecked) {
  const Scene s = droppedBall(0.5);
  OdeContacts contacts(s);
  for (double T : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(simulate(s, contacts, T), InputError) << T;
  EXPECT_EQ(simulate(s, contacts, 0).end, 0);
}

}  // namespace
}  // namespace carom
