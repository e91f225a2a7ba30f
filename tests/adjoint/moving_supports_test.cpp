// SPDX-License-Identifier: MIT
// Bodies on supports that move as they are given to: lifts, sledges, turntables, tilting plates. Ground truths of 40 digits
// come with the equations that give them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/flight/trajectory.hpp"
#include "adjoint/flight/trajectory_linearization.hpp"
#include "adjoint/motion/lasting_contact.h"
#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::moving_supports {
namespace {

using namespace test;

constexpr double kG = 9.81;
const Vec3 kDown(0, 0, -kG);

Body moving(Body body, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  body.kinematic = true;
  body.mass.reset();
  body.velocity = velocity, body.angular_velocity = spin;
  return body;
}

Scene inReverse(Scene scene) {
  std::ranges::reverse(scene.bodies);
  return scene;
}

const BodyDerivative& of(const Scene& scene, const SceneGradient& g, const char* body) {
  return g.bodies[static_cast<std::size_t>(bodyIndex(scene, body))];
}

// A ball that touches a body which turns about z, and rolls there: v - r w x n = Omega x p.
Body rolling(const Vec3& place, const Vec3& velocity, double radius, double omega) {
  Body ball = makeBall("ball", radius, place, velocity);
  ball.angular_velocity = Vec3::UnitZ().cross(Vec3(velocity - omega * Vec3::UnitZ().cross(place))) / radius;
  return ball;
}

// A lift at 1 m/s, a ball 1 m above it, elasticity 0.8: meets at (sqrt(1 + 2 g) - 1)/g, and is at rest on it at
// t + (g t + 1)(2 e/(1 - e))/g.
TEST(MovingSupports, ABallSettlesOnALift) {
  const double meets = (std::sqrt(1 + 2 * kG) - 1) / kG;
  for (const bool reverse : {false, true}) {
    Scene scene = makeScene(kDown, 0.8, 0.3, {moving(makeBox("lift", {4, 4, 0.2}, {0, 0, -0.1}), {0, 0, 1}), makeBall("ball", 0.1, {0, 0, 1.1})});
    if (reverse) scene = inReverse(scene);
    const int ball = bodyIndex(scene, "ball");
    const Motion m = playLasting(scene, 6);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    expectEntries(m.events.front().time, meets, 1e-15, "first impact");
    EXPECT_NEAR(meets, 0.36095056227289413, 1e-16);
    ASSERT_TRUE(m.events.back().settles_at);
    // at z = 4 m the last bounces, of 4e-6 m/s, are known to 4e-16 m / 4e-6 m/s
    expectEntries(*m.events.back().settles_at, 4.064049453932092, 1e-9, "settles at");
    EXPECT_EQ(m.world_lines[static_cast<std::size_t>(ball)].arcs.back().kind(), ArcKind::ride);
    expectEntries(m.stateAt(ball, 6).position, Vec3(0, 0, 6.1), 1e-13, "place");
    expectEntries(m.stateAt(ball, 6).velocity, Vec3(0, 0, 1), 1e-13, "velocity");
    const SceneGradient d = gradientOf(m, ball, 6, 2);
    expectEntries(of(scene, d, "lift").velocity.z(), 6, 1e-11, "by the lift's velocity");
    expectEntries(of(scene, d, "lift").position.z(), 1, 1e-11, "by the lift's height");
    expectEntries(of(scene, d, "ball").position.z(), 0, 1e-11, "by the ball's height");
    expectTransposed(m, 1, 1e-10);  // times of these bounces by its velocity, over 4e-6 m/s
  }
}

// A box set on a sledge slides back for v/(mu g) s, and rides on.
TEST(MovingSupports, ABoxComesToRestOnASledge) {
  const double v = 1.25, mu = 0.3, T = 2, sticks = v / (mu * kG);
  for (const bool reverse : {false, true}) {
    Scene scene = makeScene(kDown, 0, mu, {moving(makeBox("sledge", {8, 8, 0.2}, {0, 0, -0.1}), {v, 0, 0.5}),
                                           makeBox("box", {0.2, 0.2, 0.2}, {0, 0, 0.1}, {0, 0, 0.5})});
    if (reverse) scene = inReverse(scene);
    const int box = bodyIndex(scene, "box");
    const Motion m = playLasting(scene, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    expectEntries(m.events[1].time, sticks, 1e-13, "sticks");
    EXPECT_EQ(m.world_lines[static_cast<std::size_t>(box)].arcs.back().kind(), ArcKind::ride);
    expectEntries(m.stateAt(box, T).position, Vec3(v * T - 0.5 * v * sticks, 0, 0.1 + 0.5 * T), 1e-13, "place");
    expectEntries(m.stateAt(box, T).velocity, Vec3(v, 0, 0.5), 1e-13, "velocity");
    const std::vector<LastingContact> contacts = lastingContacts(m);
    ASSERT_EQ(contacts.size(), 2u);
    EXPECT_EQ(contacts[1].kind, ArcKind::ride);
    EXPECT_EQ(contacts[1].body, box);
    const SceneGradient d = gradientOf(m, box, T, 0);
    expectEntries(of(scene, d, "sledge").velocity.x(), T - sticks, 1e-11, "by the sledge's velocity");
    expectEntries(d.materials[0].friction, 0.5 * v * sticks / mu, 1e-11, "by friction");
    expectEntries(gradientOf(m, box, T, 2).gravity.z(), 0, 1e-11, "height by gravity");
    expectEntries(d.gravity.z(), -0.5 * v * sticks / kG, 1e-11, "by gravity");
    expectTransposed(m, 2);
  }
}

// (1 + k) v' = g_t + k Omega n x v with k = 2/5: circles at 2 Omega / 7, and drift.
TEST(MovingSupports, ABallRollsOnATurntable) {
  const double omega = 3, r = 0.1;
  for (const bool reverse : {false, true}) {
    Scene scene = makeScene(kDown, 0, 0.9, {moving(makeBox("table", {40, 40, 0.2}, {0, 0, -0.1}), Vec3::Zero(), {0, 0, omega}),
                                            rolling({0.3, 0.1, r}, {0.4, -0.2, 0}, r, omega)});
    if (reverse) scene = inReverse(scene);
    const int ball = bodyIndex(scene, "ball");
    const Motion m = playLasting(scene, 2);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.world_lines[static_cast<std::size_t>(ball)].arcs.back().kind(), ArcKind::roll);
    expectEntries(m.stateAt(ball, 2).position, Vec3(1.0285701740653265, 0.40246345779419465, r), 1e-12, "place");
    const Vec2 expected(-0.14902631961845815, 0.18217132782021692);
    for (int i = 0; i < 2; ++i) {  // the ball begins to roll whatever the table does
      const SceneGradient d = gradientOf(m, ball, 2, i);
      const double by_omega = of(scene, d, "table").angular_velocity.z() + of(scene, d, "ball").angular_velocity.dot(Vec3(0.3, 0.1, 0)) / r;
      expectEntries(by_omega, expected[i], 1e-9, "by the table's spin");
    }
    expectTransposed(m, 3);
  }
}

TEST(MovingSupports, ABallRollsOnATiltedTurntable) {
  const double omega = 3, r = 0.1, tilt = 0.05;
  const Scene scene = makeScene(kG * Vec3(std::sin(tilt), 0, -std::cos(tilt)), 0, 0.9,
                                {moving(makeBox("table", {40, 40, 0.2}, {0, 0, -0.1}), Vec3::Zero(), {0, 0, omega}),
                                 rolling({0, 0, r}, {0.4, -0.2, 0}, r, omega)});
  const Motion m = playLasting(scene, 2);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  expectEntries(m.stateAt(1, 2).position, Vec3(1.2734100266254143, 0.64784532777211809, r), 1e-12, "place");
  expectEntries(gradientOf(m, 1, 2, 0).gravity.dot(kG * Vec3(std::cos(tilt), 0, std::sin(tilt))), 10.887714873187952, 1e-9, "by tilt");
  expectTransposed(m, 4);
}

// What hardly turns, at one contact, is set on a turntable at R, and sticks in the end.
TEST(MovingSupports, ABlockIsSetOnATurntable) {
  const double omega = 2, R = 0.4, mu = 0.3;
  Body block = makeBall("block", 0.1, {R, 0, 0.1});
  block.inertia = Inertia::fromMoments(Vec3::Constant(1e14));
  for (const bool reverse : {false, true}) {
    Scene scene = makeScene(kDown, 0, mu, {moving(makeBox("table", {8, 8, 0.2}, {0, 0, -0.1}), Vec3::Zero(), {0, 0, omega}), block});
    if (reverse) scene = inReverse(scene);
    const int body = bodyIndex(scene, "block");
    const Motion m = playLasting(scene, 0.5);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    EXPECT_EQ(m.events[1].cause, TransitionCause::sticks);
    expectEntries(m.events[1].time, 0.30907453176159096, 1e-12, "sticks");
    expectEntries(m.stateAt(body, m.events[1].time).position, Vec3(0.38273025427024124, 0.13595082844537918, 0.1), 1e-12, "place");
  }
}

// A plate turns about a line in its top, from level on: a box slips where its tilt and its own acceleration need all friction.
TEST(MovingSupports, ABoxSlipsOnATiltingPlate) {
  const double w = 0.5, d = 0.4, h = 0.05, mu = 0.3;
  Body plate = moving(makeBox("plate", {4, 4, 0.2}, {0, 0, -0.1}), Vec3::Zero(), {0, -w, 0});
  plate.center_of_mass = Vec3(0, 0, 0.1);
  Body box = makeBox("box", {2 * h, 2 * h, 2 * h}, {d, 0, h}, Vec3(0, -w, 0).cross(Vec3(d, 0, h)));
  box.angular_velocity = {0, -w, 0};
  for (const bool reverse : {false, true}) {
    Scene scene = makeScene(kDown, 0, mu, {plate, box});
    if (reverse) scene = inReverse(scene);
    const int body = bodyIndex(scene, "box");
    const Motion m = playLasting(scene, 0.8);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    EXPECT_EQ(m.world_lines[static_cast<std::size_t>(body)].arcs[1].kind(), ArcKind::ride);
    EXPECT_EQ(m.events[1].cause, TransitionCause::slips);
    expectEntries(m.events[1].time, 0.60170913166433853, 1e-12, "slips");
    StateSeed time;
    time.body = body, time.at = Instant::before(1), time.time = 1;
    const SceneGradient g = adjoint(m, std::vector{time});
    expectEntries(g.materials[0].friction, 1.8272480964382193, 1e-9, "by friction");
    expectEntries(-g.gravity.z(), -0.0019160138692218546, 1e-9, "by gravity");
    expectTransposed(m, 6);
  }
}

Body beltAt(double speed, const Vec3& size = {40, 40, 0.2}) {
  Body belt = fixedBody(makeBox("belt", size, {0, 0, -0.1}));
  belt.surface_velocity = {speed, 0, 0};
  return belt;
}

// A ball that is set down on a belt rolls at 2/7 of its speed after 2 v/(7 mu g).
TEST(MovingSupports, ABallIsSetOnABelt) {
  const double v = 1.5, mu = 0.3, rolls = 2 * v / (7 * mu * kG), T = 0.5;
  EXPECT_NEAR(rolls, 0.14562399883500801, 1e-16);
  for (const bool reverse : {false, true}) {
    Scene scene = makeScene(kDown, 0, mu, {beltAt(v), makeBall("ball", 0.1, {0, 0, 0.1})});
    if (reverse) scene = inReverse(scene);
    const int ball = bodyIndex(scene, "ball");
    const Motion m = playLasting(scene, T);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    expectEntries(m.events[1].time, rolls, 1e-13, "rolls");
    expectEntries(m.stateAt(ball, T).velocity, Vec3(2 * v / 7, 0, 0), 1e-13, "velocity");
    expectEntries(m.stateAt(ball, T).position.x(), 2 * v / 7 * (T - rolls / 2), 1e-13, "place");
    EXPECT_EQ(m.world_lines[static_cast<std::size_t>(ball)].arcs.back().kind(), ArcKind::roll);
    const SceneGradient d = gradientOf(m, ball, T, 0);
    expectEntries(of(scene, d, "belt").surface_velocity.x(), 2.0 / 7 * T - 2 * rolls / 7, 1e-11, "by the belt's speed");
    expectEntries(d.materials[0].friction, v * rolls / (7 * mu), 1e-11, "by friction");
    expectTransposed(m, 7);
  }
}

// A box that slides across a belt is carried after sqrt(v^2 + u^2)/(mu g), along the way of its slip.
TEST(MovingSupports, ABoxSlidesAcrossABelt) {
  const double v = 1.5, u = 2, mu = 0.3, slip = std::hypot(v, u), carried = slip / (mu * kG);
  EXPECT_NEAR(carried, 0.84947332653754672, 1e-15);
  for (const bool reverse : {false, true}) {
    Scene scene = makeScene(kDown, 0, mu, {beltAt(v), makeBox("box", {0.2, 0.2, 0.1}, {0, 0, 0.05}, {0, u, 0})});
    if (reverse) scene = inReverse(scene);
    const int box = bodyIndex(scene, "box");
    const Motion m = playLasting(scene, 1);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    EXPECT_EQ(m.world_lines[static_cast<std::size_t>(box)].arcs.back().kind(), ArcKind::ride);
    expectEntries(m.events[1].time, carried, 1e-12, "carried");
    expectEntries(m.stateAt(box, carried).position, Vec3(0.63710499490316004, 0.84947332653754672, 0.05), 1e-12, "place");
    expectEntries(m.stateAt(box, 1).velocity, Vec3(v, 0, 0), 1e-12, "velocity");
    StateSeed place;
    place.body = box, place.at = Instant::before(1), place.position = Vec3::UnitX();
    const SceneGradient d = adjoint(m, std::vector{place});  // where four slips end together, to 4e-9
    expectEntries(of(scene, d, "belt").surface_velocity.x(), 0.57764186204553177, 1e-8, "by the belt's speed");
    expectEntries(of(scene, d, "box").velocity.y(), 0.20387359836901121, 1e-8, "by the box's");
    expectEntries(d.materials[0].friction, -2.1236833163438668, 1e-8, "by friction");
    expectEntries(-d.gravity.z(), -0.064944443924888893, 1e-8, "by gravity");
    const SceneGradient later = gradientOf(m, box, 1, 0);
    const double by_speed = 0.57764186204553177 + 1 - carried - v * v / (slip * mu * kG);
    expectEntries(of(scene, later, "belt").surface_velocity.x(), by_speed, 1e-9, "later, by the belt's speed");
    expectTransposed(m, 8, 1e-12);
  }
}

// To its end, where it tips over.
TEST(MovingSupports, ABeltCarriesABoxToItsEnd) {
  const double v = 1, length = 0.5;
  const Scene scene = makeScene(kDown, 0, 0.6, {beltAt(v, {2 * length, 2, 0.2}), makeBox("box", {0.2, 0.2, 0.1}, {0, 0, 0.05}, {v, 0, 0})});
  const Motion m = playLasting(scene, 0.6);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_EQ(m.world_lines[1].arcs[1].kind(), ArcKind::ride);
  ASSERT_GE(m.events.size(), 3u);
  EXPECT_EQ(m.events[1].cause, TransitionCause::leaves);
  expectEntries(m.events[1].time, (length - 0.1) / v, 1e-13, "its front leaves the belt");
  EXPECT_GT(m.stateAt(1, 0.6).angular_velocity.y(), 0.1);
}

// A plate that turns is a plate at rest whose surface turns.
TEST(MovingSupports, ATurntableIsAPlateWithASurfaceThatTurns) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double omega = random.in(-3, 3);
    Body body = seed % 2 ? makeBall("body", 0.1, {0.3, 0.1, 0.3}, random.vec(0.5)) : makeBox("body", {0.2, 0.15, 0.1}, {0.3, 0.1, 0.05});
    body.angular_velocity = seed % 2 ? random.vec(3) : Vec3(0, 0, random.in(-2, 2));
    const Body plate = makeBox("plate", {30, 30, 0.2}, {0, 0, -0.1});
    Body still = fixedBody(plate);
    still.surface_angular_velocity = {0, 0, omega};
    const Motion a = playLasting(makeScene(kDown, 0, 0.3, {moving(plate, Vec3::Zero(), {0, 0, omega}), body}), 1);
    const Motion b = playLasting(makeScene(kDown, 0, 0.3, {still, body}), 1);
    ASSERT_EQ(a.status, MotionStatus::complete) << a.message;
    ASSERT_EQ(b.status, MotionStatus::complete) << b.message;
    ASSERT_EQ(a.events.size(), b.events.size());
    expectEntries(changeOf(a.stateAt(1, 1), b.stateAt(1, 1)), Eigen::Matrix<double, 12, 1>::Zero(), 1e-11, "state");
    for (int i = 0; i < 3; ++i)
      expectEntries(gradientOf(a, 1, 1, i).bodies[0].angular_velocity.z(), gradientOf(b, 1, 1, i).bodies[0].surface_angular_velocity.z(), 1e-9, "by the turn");
    expectTransposed(b, seed, 1e-11);
  }
}

// Replayed with other numbers, they are those of a simulation.
TEST(MovingSupports, Replays) {
  std::vector<Scene> scenes = {
      makeScene(kDown, 0, 0.3, {moving(makeBox("sledge", {8, 8, 0.2}, {0, 0, -0.1}), {1.2, 0, 0.5}), makeBox("box", {0.2, 0.2, 0.2}, {0, 0, 0.1}, {0, 0, 0.5})}),
      makeScene(kDown, 0, 0.9, {moving(makeBox("table", {40, 40, 0.2}, {0, 0, -0.1}), Vec3::Zero(), {0, 0, 3}), makeBall("ball", 0.1, {0.3, 0.1, 0.3}, {1, 0, 0})}),
      makeScene(kDown, 0, 0.3, {beltAt(1.5), makeBox("box", {0.2, 0.2, 0.1}, {0, 0, 0.05}, {0, 1, 0})})};
  for (const Scene& scene : scenes) {
    const Motion was = playLasting(scene, 1);
    ASSERT_EQ(was.status, MotionStatus::complete) << was.message;
    Scene other = scene;
    other.materials[0].friction *= 1.05;
    other.bodies[0].velocity.x() *= 1.03, other.bodies[0].angular_velocity *= 0.98, other.bodies[0].surface_velocity *= 1.04;
    other.bodies[1].velocity.y() += 0.02;
    const Motion expected = playLasting(other, 1);
    const MotionAlong along = simulateAlong(was, other, was.geometry, 1);
    ASSERT_TRUE(along.complete) << along.why_not;
    ASSERT_EQ(along.motion.events.size(), expected.events.size());
    expectEntries(changeOf(expected.stateAt(1, 1), along.motion.stateAt(1, 1)), Eigen::Matrix<double, 12, 1>::Zero(), 1e-11, scene.bodies[0].name);
  }
}

/// Rises by `height` within `time` as a cubic with no speed at both ends, and stays there.
class KeyedLift final : public adjoint_detail::Trajectory {
 public:
  KeyedLift(const Vec3& from, double height, double time) : from_(from), height_(height), time_(time) {}

  ArcKind kind() const override { return ArcKind::flight; }
  bool isGiven() const override { return true; }
  Vec3 positionAt(const Arc&, double t) const override {
    const double s = std::min(t / time_, 1.0);
    return from_ + height_ * s * s * (3 - 2 * s) * Vec3::UnitZ();
  }
  Vec3 velocityAt(const Arc&, double t) const override {
    const double s = std::min(t / time_, 1.0);
    return height_ * 6 * s * (1 - s) / time_ * Vec3::UnitZ();
  }
  State stateAt(const Arc& arc, double t) const override { return {positionAt(arc, t), Quat::Identity(), velocityAt(arc, t), Vec3::Zero()}; }
  StateDerivative rateAt(const Arc& arc, double t, const State&) const override {
    StateDerivative rate;
    rate.x = velocityAt(arc, t);
    if (t < time_) rate.v = height_ * 6 * (1 - 2 * t / time_) / (time_ * time_) * Vec3::UnitZ();
    return rate;
  }
  adjoint_detail::TrajectoryBounds bounds(const Arc& arc) const override {
    return {rateAt(arc, arc.start(), {}).v, 12 * height_ / (time_ * time_), false, 0, 0};
  }
  std::shared_ptr<const adjoint_detail::TrajectoryLinearization> linearise(const Motion&, int, int, double) const override {
    return std::make_shared<Nothing>();
  }

 private:
  class Nothing final : public adjoint_detail::TrajectoryLinearization {
    StateDerivative tangent(const StateDerivative&, const SceneTangent&, const BodyModelDerivative&) const override { return {}; }
    StateDerivative pullback(const StateDerivative&, SceneGradient&, BodyModelDerivative&) const override { return {}; }
  };

  Vec3 from_;
  double height_, time_;
};

// From 0 to 1 m in 0.5 s: the box leaves where the lift slows down by g, at T/2 (1 + g T^2/(6 H)), and lands on it at rest.
TEST(MovingSupports, ABoxLeavesALiftThatSlowsDown) {
  const double H = 1, T = 0.5, leaves = T / 2 * (1 + kG * T * T / (6 * H));
  const Scene scene = makeScene(kDown, 0, 0.3, {moving(makeBox("lift", {4, 4, 0.2}, {0, 0, -0.1}), Vec3::Zero()), makeBox("box", {0.2, 0.2, 0.2}, {0, 0, 0.1})});
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.given[0] = std::make_shared<KeyedLift>(Vec3(0, 0, -0.1), H, T);
  const Motion m = simulate(scene, contacts, 1, options);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  ASSERT_GE(m.events.size(), 3u);
  EXPECT_NEAR(leaves, 0.3521875, 1e-12);
  expectEntries(m.events[1].time, leaves, 1e-12, "leaves");
  expectEntries(m.stateAt(1, leaves).position.z(), 0.1 + 0.78948936376953125, 1e-12, "height");
  expectEntries(m.stateAt(1, leaves).velocity.z(), 2.4987703125, 1e-12, "speed");
  expectEntries(m.events[2].time, 0.75510337035055749, 1e-12, "lands");
  expectEntries(m.stateAt(1, 1).position, Vec3(0, 0, 1.1), 1e-12, "place at the end");
  StateSeed time;
  time.body = 1, time.at = Instant::before(1), time.time = 1;
  EXPECT_THROW(adjoint(m, std::vector{time}), NotComputable) << "nobody says how the lift's acceleration changes";
}

// The same scene seen from a frame that moves uniformly: floors on which bodies have closed forms, and constrained motion.
TEST(MovingSupports, AUniformlyMovingFrameChangesNothing) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Vec3 V = random.vec(1);
    Body body = seed % 3 == 0 ? makeBall("body", 0.1, {0, 0, 0.35}) : makeBox("body", {0.2, 0.15, 0.1}, {0, 0, 0.35});
    if (seed % 3 == 1) body.shape = Capsule{0.07, 0.2};
    body.orientation = random.rotation();
    body.velocity = random.vec(1), body.angular_velocity = random.vec(2);
    Scene still = makeScene(kDown, 0, random.in(0.1, 0.6), {fixedBody(makeBox("floor", {30, 30, 1}, {0, 0, -0.5})), body});
    Scene carried = still;
    carried.bodies[0].fixed = false;
    carried.bodies[0] = moving(carried.bodies[0], V);
    carried.bodies[1].velocity += V;
    const double T = 0.6;
    const Motion a = playLasting(still, T), b = playLasting(carried, T);
    ASSERT_EQ(a.status, MotionStatus::complete) << a.message;
    ASSERT_EQ(b.status, MotionStatus::complete) << b.message;
    if (a.impacts != b.impacts) continue;
    ++compared;
    double largest = 1;
    for (int i = 0; i < 12; ++i) {
      const BodyDerivative d = gradientOf(a, 1, T, i).bodies[1];
      for (const Vec3& of : {d.position, d.orientation, d.velocity, d.angular_velocity}) largest = std::max(largest, of.cwiseAbs().maxCoeff());
    }
    Eigen::Matrix<double, 12, 1> change = changeOf(a.stateAt(1, T), b.stateAt(1, T));
    change.head<3>() -= V * T, change.segment<3>(6) -= V;
    expectEntries(change, Eigen::Matrix<double, 12, 1>::Zero(), 1e-12 * largest, "state");
    expectTransposed(b, seed, 3e-11);  // boxes that settle: 5e-12 on ground that stands still
  }
  EXPECT_GE(compared, 20);
}

}  // namespace
}  // namespace carom::moving_supports
