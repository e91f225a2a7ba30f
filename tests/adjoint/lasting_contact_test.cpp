// SPDX-License-Identifier: MIT
// Contact that lasts, against closed forms (g = 9.81 m/s^2): places, times and derivatives of balls that bounce, slide,
// roll, and leave a table, and of blocks that slide to rest.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate_along.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::lasting_contact {
namespace {

using namespace test;

constexpr double kState = 1e-10;
constexpr double kDerivative = 1e-8;
const Vec3 kDown(0, 0, -9.81);

Scene onFloor(const Vec3& gravity, double elasticity, double friction, Body body) {
  return makeScene(gravity, elasticity, friction, {std::move(body), makePlane("floor", Vec3::UnitZ(), 0)});
}
Body ballWith(double height, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
  Body ball = makeBall("ball", 0.1, {0, 0, height}, velocity);
  ball.angular_velocity = spin;
  return ball;
}
SceneGradient gradientOf(const Motion& motion, const StateSeed& seed) {
  return adjoint(motion, std::span<const StateSeed>(&seed, 1));
}
StateSeed readX(const Instant& at) {
  StateSeed seed;
  seed.body = 0;
  seed.at = at;
  seed.position = Vec3::UnitX();
  return seed;
}
StateSeed readTime(int event) {
  StateSeed seed;
  seed.body = 0;
  seed.at = Instant::before(event);
  seed.time = 1;
  return seed;
}

TEST(LastingContact, ABallBouncesToRest) {
  const double drop = std::sqrt(2 / 9.81);
  for (int i = 2; i <= 19; ++i) {
    const double e = 0.05 * i;
    SCOPED_TRACE("e = " + std::to_string(e));
    const Motion m = playLasting(onFloor(kDown, e, 0.3, ballWith(1.1, Vec3::Zero())), 20);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    const Event& last = m.events.back();
    EXPECT_EQ(last.kind, EventKind::capture);
    ASSERT_TRUE(last.settles_at);
    const double settles = drop * (1 + e) / (1 - e);
    expectEntries(*last.settles_at, settles, 1e-12, "settles at", settles);
    EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::rest);
    expectEntries(m.stateAt(0, 20).position, Vec3(0, 0, 0.1), 1e-12, "place of rest");
    EXPECT_EQ(m.stateAt(0, 20).velocity, Vec3::Zero());
  }
}

TEST(LastingContact, ABallBouncesSlidesAndRolls) {
  const Motion m = playLasting(onFloor(kDown, 0.6, 0.03, ballWith(1.1, {3, 0, 0})), 4);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  const std::size_t last = m.events.size() - 1;
  EXPECT_EQ(m.events[last - 1].kind, EventKind::capture);
  EXPECT_EQ(m.events[last].cause, TransitionCause::slip_ends);
  expectEntries(m.events[last - 1].settles_at.value(), 1.80609456394292, 1e-12, "settles at");
  expectEntries(m.events[last].time, 2.91247997670016, kState, "rolls from");
  const BodyState end = m.stateAt(0, 4);
  expectEntries(end.position.x(), 9.84963427572864, kState, "x");
  expectEntries(end.velocity, Vec3(15.0 / 7, 0, 0), kState, "v");
  const SceneGradient g = gradientOf(m, readX(Instant::at(4)));
  expectEntries(g.bodies[0].velocity.x(), 3.68927999334290, kDerivative, "dx/dv");
  expectEntries(g.materials[0].elasticity, 0.0, 1e-12, "dx/de");
  expectEntries(g.materials[0].friction, -40.6068568100023, kDerivative, "dx/dmu");
  expectEntries(-g.gravity.z(), -0.12723809422019, kDerivative, "dx/dg");
  expectEntries(g.bodies[0].position.z(), 0.03, kDerivative, "dx/dh");
}

TEST(LastingContact, ASlidingBallRolls) {
  const Motion m = playLasting(onFloor(kDown, 0.5, 0.3, ballWith(0.1, {3, 0, 0})), 2);
  ASSERT_EQ(m.events.size(), 2u);
  EXPECT_EQ(m.events[0].kind, EventKind::placed);
  expectEntries(m.events[1].time, 0.29124799767002, kState, "rolls from");
  expectEntries(m.stateBefore(1, 0).position.x(), 0.74892342258004, kState, "x there");
  expectEntries(m.stateAt(0, 2).velocity.x(), 15.0 / 7, kState, "v");
}

TEST(LastingContact, BackSpinBringsABallBack) {
  const Motion m = playLasting(onFloor(kDown, 0.5, 0.3, ballWith(0.1, {2, 0, 0}, {0, -80, 0})), 2);
  ASSERT_EQ(m.events.size(), 2u);
  expectEntries(m.events[1].time, 0.97082665890005, kState, "rolls from");
  expectEntries(m.stateAt(0, 0.67957866123004).velocity.x(), 0.0, kState, "turns");
  expectEntries(m.stateAt(0, 1.61804443150009).position.x(), 0.0, kState, "is back");
  expectEntries(m.stateAt(0, 2).velocity.x(), -6.0 / 7, kState, "v");
}

TEST(LastingContact, ABallAcrossASlope) {
  const Motion m = playLasting(onFloor(downSlope(10), 0.5, 0.1, ballWith(0.1, {0, 2, 0})), 2);
  ASSERT_EQ(m.events.size(), 2u);
  expectEntries(m.events[1].time, 0.79266482336523, kState, "rolls from");
  expectEntries(m.stateBefore(1, 0).velocity, Vec3(0.96449679170406, 10.0 / 7, 0), kState, "v there");
  expectEntries(m.stateBefore(1, 0).position, Vec3(0.43930958238062, 1.31282260702663, 0.1), kState, "x there");
}

TEST(LastingContact, ABallRollsDownASlopeThatHoldsIt) {
  for (double degrees : {5.0, 20.0, 45.0}) {
    SCOPED_TRACE(std::to_string(degrees) + " degrees");
    const Motion m = playLasting(onFloor(downSlope(degrees), 0.5, 0.3, ballWith(0.1, Vec3::Zero())), 1);
    const double along = downSlope(degrees).x(), pressing = -downSlope(degrees).z();
    const bool rolls = along <= 3.5 * 0.3 * pressing;
    const double acceleration = rolls ? 5.0 / 7 * along : along - 0.3 * pressing;
    expectEntries(m.stateAt(0, 1).velocity.x(), acceleration, kState, "v");
    EXPECT_EQ(m.world_lines[0].arcs.back().kind(), rolls ? ArcKind::roll : ArcKind::slide);
  }
}

Scene offTheTable(double speed, double friction) {
  Body ball = makeBall("ball", 0.05, {0, 0, 0.05}, {speed, 0, 0});
  return makeScene(kDown, 0, friction,
                   {ball, fixedBody(makeBox("table", {2, 2, 0.75}, {0, 0, -0.375})),
                    makePlane("floor", Vec3::UnitZ(), -0.75)});
}

TEST(LastingContact, AFastBallFliesOffATable) {
  const Motion m = playLasting(offTheTable(1.68, 0.2), 1.3);
  ASSERT_EQ(m.events.size(), 4u);
  EXPECT_EQ(m.events[2].cause, TransitionCause::leaves);
  EXPECT_EQ(m.world_lines[0].arcs[3].kind(), ArcKind::flight);
  expectEntries(m.events[3].time, 1.17543461322766, kState, "lands at");
  expectEntries(m.stateBefore(3, 0).position.x(), 1.46923713220347, kState, "x there");
  const SceneGradient x = gradientOf(m, readX(Instant::before(3))), t = gradientOf(m, readTime(3));
  expectEntries(x.bodies[0].velocity.x(), 0.27930781678778, kDerivative, "dx/dv");
  expectEntries(x.materials[0].friction, 0.0, kDerivative, "dx/dmu");
  expectEntries(t.materials[0].friction, 0.24464831804281, kDerivative, "dt/dmu");
  expectEntries(t.bodies[0].velocity.x(), -0.52515654579875, kDerivative, "dt/dv");
  EXPECT_EQ(m.findImpact(0, 1), 3);
}

TEST(LastingContact, ABlockSlidesToRest) {
  const Body block = makeBox("block", {.4, .3, .2}, {0, 0, .1}, {2, 0, 0});
  const Motion m = playLasting(onFloor(kDown, 0.5, 0.3, block), 3);
  ASSERT_EQ(m.events.size(), 2u);
  expectEntries(m.events[1].time, 2 / (0.3 * 9.81), kState, "stops at");
  expectEntries(m.stateAt(0, 3).position.x(), 4 / (2 * 0.3 * 9.81), kState, "x");
  EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::rest);
  const SceneGradient g = gradientOf(m, readX(Instant::at(3)));
  expectEntries(g.bodies[0].velocity.x(), 2 / (0.3 * 9.81), kDerivative, "dx/dv");
  expectEntries(g.materials[0].friction, -4 / (2 * 0.09 * 9.81), kDerivative, "dx/dmu");
}

TEST(LastingContact, ABlockAcrossASlope) {
  const Body block = makeBox("block", {.4, .3, .2}, {0, 0, .1}, {0, 2, 0});
  const Motion m = playLasting(onFloor(downSlope(20), 0.5, 0.5, block), 2);
  ASSERT_EQ(m.events.size(), 2u);
  expectEntries(m.events[1].time, 0.92302283587126, kState, "stops at");
  expectEntries(m.stateAt(0, 2).position, Vec3(0.33595283780512, 0.50017598242841, 0.1), kState, "x");
}

TEST(LastingContact, ABlockOnASlopeRestsWhereFrictionHoldsIt) {
  const Body block = makeBox("block", {.4, .3, .2}, {0, 0, .1});
  const Motion rests = playLasting(onFloor(downSlope(20), 0.5, std::tan(20.1 * std::acos(-1.0) / 180), block), 2);
  EXPECT_EQ(rests.world_lines[0].arcs.back().kind(), ArcKind::rest);
  EXPECT_EQ(rests.stateAt(0, 2).position, block.position);
  const Motion slides = playLasting(onFloor(downSlope(20), 0.5, 0.3, block), 2);
  EXPECT_EQ(slides.world_lines[0].arcs.back().kind(), ArcKind::slide);
  expectEntries(slides.stateAt(0, 2).velocity.x(), 2 * (downSlope(20).x() + 0.3 * downSlope(20).z()), kState, "v");
}

TEST(LastingContact, ASlabLandsFlat) {
  const Body slab = makeBox("slab", {.4, .3, .2}, {0, 0, .3}, {1, .5, 0});
  const Motion m = playLasting(onFloor(kDown, 0.6, 0.3, slab), 3);
  EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::rest);
  expectEntries(m.stateAt(0, 3).position.z(), 0.1, 1e-12, "height");
}

// Nothing that happens in contact depends on how high above the floor the body was written, and all of it goes along
// with the floor.
TEST(LastingContact, RestGoesWithTheFloor) {
  const Scene written = onFloor(kDown, 0.5, 0.3, makeBox("block", {.4, .3, .2}, {0, 0, .1}, {2, 0, 0}));
  for (double above : {1e-13, -1e-10}) {  // of a block of 0.27 m
    Scene scene = written;
    scene.bodies[0].position.z() += above;
    const Motion m = playLasting(scene, 3);
    ASSERT_EQ(m.events.front().kind, EventKind::placed);
    expectEntries(m.stateAt(0, 3).position, Vec3(4 / (2 * 0.3 * 9.81), 0, 0.1), 1e-15, "place");
  }
  const Motion m = playLasting(written, 3);
  StateSeed z = readX(Instant::at(3));
  z.position = Vec3::UnitZ();
  const SceneGradient g = gradientOf(m, z);
  expectEntries(g.bodies[0].position.z(), 0.0, 1e-15, "dz/dz of the block");
  expectEntries(g.bodies[1].position.z(), 1.0, 1e-15, "dz/dz of the floor");
}

TEST(LastingContact, RestAddsNothing) {
  const Scene scene = onFloor(kDown, 0.5, 0.3, makeBox("block", {.4, .3, .2}, {0, 0, .1}, {2, 0, 0}));
  const Motion brief = playLasting(scene, 1), lengthy = playLasting(scene, 61);
  ASSERT_EQ(brief.events.size(), lengthy.events.size());
  const BodyState a = brief.stateAt(0, 1), b = lengthy.stateAt(0, 61);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
  EXPECT_LE(lengthy.steps, brief.steps + 5);
}

TEST(LastingContact, NothingIsCapturedWithoutAReason) {
  const Motion weightless = playLasting(onFloor(Vec3::Zero(), 0, 0.3, ballWith(0.5, {0.1, 0, -1})), 2);
  EXPECT_EQ(weightless.status, MotionStatus::complete);
  EXPECT_EQ(weightless.world_lines[0].arcs.back().kind(), ArcKind::flight);
  const Motion elastic = playLasting(onFloor(kDown, 1, 0, ballWith(1.1, {1, 0, 0})), 20);
  EXPECT_EQ(elastic.status, MotionStatus::complete);
  for (const Event& e : elastic.events) EXPECT_EQ(e.kind, EventKind::impact);
  const Motion slippery = playLasting(onFloor(kDown, 0, 0, ballWith(0.5, {1, 0, 0})), 20);
  EXPECT_EQ(slippery.status, MotionStatus::complete);
  expectEntries(slippery.stateAt(0, 20).position.x(), 20.0, kState, "x");
}

TEST(LastingContact, WhatRestsWakesWhenItIsHit) {
  const DotProductScene* wakes = nullptr;
  const std::vector<DotProductScene> rows = lastingScenes();
  for (const DotProductScene& row : rows)
    if (std::string(row.name) == "lasting_wakes") wakes = &row;
  ASSERT_NE(wakes, nullptr);
  const Motion m = playLasting(wakes->scene(), 5);
  EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_EQ(m.world_lines[0].arcs[1].kind(), ArcKind::rest);
  EXPECT_GT(m.stateAt(0, 5).velocity.x(), 0.1);
}

TEST(LastingContact, IsFollowedToTheLastBit) {
  for (const DotProductScene& row : lastingScenes()) {
    SCOPED_TRACE(row.name);
    const Scene scene = row.scene();
    const Motion m = playLasting(scene, row.duration, row.asked);
    const MotionAlong same = simulateAlong(m, scene, m.geometry, row.duration);
    EXPECT_TRUE(same.complete) << same.why_not;
    ASSERT_EQ(same.motion.events.size(), m.events.size());
    for (std::size_t e = 0; e < m.events.size(); ++e) EXPECT_EQ(same.motion.events[e].time, m.events[e].time);
    for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
      for (double t : {0.3 * m.end, 0.7 * m.end, m.end}) {
        const BodyState found = same.motion.stateAt(b, t), expected = m.stateAt(b, t);
        EXPECT_EQ(found.position, expected.position);
        EXPECT_EQ(found.orientation.coeffs(), expected.orientation.coeffs());
        EXPECT_EQ(found.velocity, expected.velocity);
      }
  }
}

// What slides off from no slip at all goes down the slope whichever way it is pushed; a block that slides, and what rolls,
// goes the way it is pushed.
TEST(LastingContact, DerivativesByTheVelocityOfWhatBeginsToSlideAreInDoubt) {
  const StateSeed seed = readX(Instant::at(1));
  const Body block = makeBox("block", {0.4, 0.3, 0.2}, {0, 0, 0.1}), ball = ballWith(0.1, Vec3::Zero());
  for (const Body& body : {block, ball}) {
    SCOPED_TRACE(body.name);
    Reliability starts;
    adjoint(playLasting(onFloor(downSlope(60), 0.5, 0.3, body), 1), std::span<const StateSeed>(&seed, 1), &starts);
    EXPECT_TRUE(starts.reliable) << starts.message;
    starts.askVelocity(1);
    EXPECT_TRUE(starts.reliable) << starts.message;
    starts.askVelocity(0);
    EXPECT_FALSE(starts.reliable);
    EXPECT_EQ(starts.smallest_margin, 0);
    EXPECT_NE(starts.message.find("starts to slip from zero slip"), std::string::npos) << starts.message;

    Body moves = body;
    moves.velocity = {1, 0.2, 0};
    Reliability slides;
    adjoint(playLasting(onFloor(kDown, 0.5, 0.3, moves), 1), std::span<const StateSeed>(&seed, 1), &slides);
    slides.askVelocity(0), slides.askSpin(0);
    EXPECT_TRUE(slides.reliable) << slides.message;
  }
}

}  // namespace
}  // namespace carom::lasting_contact
