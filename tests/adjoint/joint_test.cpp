// SPDX-License-Identifier: MIT
// Contacts of one instant are solved together (equation 4.4): landings and chains whose answer is known.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/adjoint/tolerances.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

Body slab() { return makeBox("slab", {0.4, 0.3, 0.2}, {0, 0, 0.8}, {1, 0.5, -2}); }

// Drops the slab flat, without gravity, on whatever has its top at z = 0.2; the impact is at t = 0.25.
Motion landFlat(const Body& ground, double friction, double tangential = 0) {
  Scene s = makeScene(Vec3::Zero(), 0.6, friction, {slab(), ground});
  s.materials[0].tangential_elasticity = tangential;
  return play(s, 0.4);
}

std::vector<Body> grounds() {
  return {makePlane("floor", Vec3::UnitZ(), 0.2), fixedBody(makeBox("larger", {3, 3, 0.2}, {0, 0, 0.1})),
          fixedBody(makeBox("smaller", {0.2, 0.1, 0.2}, {0.25, 0.125, 0.1}))};
}

void expectFlat(const Motion& m, const Vec3& velocity) {
  ASSERT_EQ(m.events.size(), 1u);
  EXPECT_EQ(m.events[0].mode, ImpactMode::joint);
  EXPECT_EQ(m.events[0].contacts.size(), 4u);
  expectEntries(m.events[0].time, 0.25, kState, "time");
  const BodyState after = m.stateAt("slab", 0.4);
  expectEntries(after.velocity, velocity, kState, "velocity");
  expectEntries(after.angular_velocity, Vec3::Zero().eval(), kState, "angular velocity");
}

TEST(Joint, FlatLandingWithoutFrictionBouncesFlat) {
  for (const Body& ground : grounds()) {
    SCOPED_TRACE(ground.name);
    expectFlat(landFlat(ground, 0), {1, 0.5, 1.2});
  }
}

// The middle of the slab is over the ground, but not over its middle.
TEST(Joint, FlatLandingOffTheMiddleBouncesFlat) {
  expectFlat(landFlat(fixedBody(makeBox("smaller", {0.2, 0.1, 0.2}, {0.3, 0.1, 0.1})), 0), {1, 0.5, 1.2});
}

TEST(Joint, FlatLandingWithGripStopsSliding) {
  for (const Body& ground : grounds()) {
    SCOPED_TRACE(ground.name);
    expectFlat(landFlat(ground, 5), {0, 0, 1.2});
    expectFlat(landFlat(ground, 5, 0.3), {-0.3, -0.15, 1.2});
  }
}

// The speed along the ground falls by mu (1 + e) 2, in its own direction, and nothing turns.
TEST(Joint, FlatLandingOnSlipperyGroundLosesWhatCoulombSays) {
  for (const double friction : {0.05, 0.3})
    for (const Body& ground : grounds()) {
      SCOPED_TRACE(ground.name);
      const double left = 1 - friction * 1.6 * 2 / std::sqrt(1.25);
      const Motion m = landFlat(ground, friction);
      expectFlat(m, {left, 0.5 * left, 1.2});
      for (const Contact& c : m.events[0].contacts)
        expectEntries(c.impulse.head<2>().norm(), friction * c.impulse.z(), kState, "its cone is full");
    }
}

TEST(Joint, FourBallsStruckInASquareStaySymmetric) {
  const double r = 0.1, d = 0.1 * std::sqrt(2.0), h = 0.1 * std::sqrt(2.0) + 0.4;
  for (double friction : {0.0, 0.3}) {
    Scene s = makeScene(Vec3::Zero(), 0.7, friction,
                        {makeBall("east", r, {d, 0, 0}), makeBall("north", r, {0, d, 0}), makeBall("west", r, {-d, 0, 0}),
                         makeBall("south", r, {0, -d, 0}), makeBall("top", r, {0, 0, h}, {0, 0, -1})});
    const Motion m = play(s, 1);
    ASSERT_GE(m.events.size(), 1u);
    EXPECT_GE(m.events[0].contacts.size(), 4u) << m.describeEvent(0);
    const double t = m.events[0].time;
    const BodyState east = m.stateAt("east", t), north = m.stateAt("north", t), top = m.stateAt("top", t);
    expectEntries(Vec2(top.velocity.head<2>()), Vec2::Zero().eval(), kState, "top, aside");
    expectEntries(m.stateAt("west", t).velocity, Vec3(-east.velocity.x(), 0, east.velocity.z()), kState, "west");
    expectEntries(north.velocity, Vec3(0, east.velocity.x(), east.velocity.z()), kState, "north");
    expectEntries(m.stateAt("south", t).velocity, Vec3(0, -east.velocity.x(), east.velocity.z()), kState, "south");
    expectEntries(east.velocity.y(), 0, kState, "east, aside");
  }
}

// Both ends of an edge strike together, which is the planar problem of one vertex at (r_x, r_z).
TEST(Joint, LandingOnAnEdgeIsThePlanarProblem) {
  const double e = 0.6, angle = 0.3, g = 9.81, h = 0.8, I = 0.02;
  Body b = slab();
  b.velocity.setZero();
  b.orientation = Quat(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  b.inertia = Inertia::fromMoments({0.015, I, 0.018});
  const Motion m = play(makeScene({0, 0, -g}, e, 0, {b, makePlane("floor", Vec3::UnitZ(), 0)}), 0.37);
  ASSERT_EQ(m.events.size(), 1u);
  EXPECT_EQ(m.events[0].contacts.size(), 2u);
  const double rx = 0.2 * std::cos(angle) - 0.1 * std::sin(angle), rz = -0.2 * std::sin(angle) - 0.1 * std::cos(angle);
  const double v = -std::sqrt(2 * g * (h + rz)), P = -(1 + e) * v / (1 + rx * rx / I);
  const double dP_dI = P * rx * rx / (I * I) / (1 + rx * rx / I);
  const BodyState after = m.stateAt("slab", m.events[0].time);
  expectEntries(after.velocity, Vec3(0, 0, v + P), kState, "velocity");
  expectEntries(after.angular_velocity, Vec3(0, -rx * P / I, 0), kState, "angular velocity");
  const SceneGradient vz = gradientOf(m, 0, 0.37, 8), wy = gradientOf(m, 0, 0.37, 10);
  expectEntries(vz.bodies[0].inertia, Vec3(0, dP_dI, 0), kDerivative, "dv/dI");
  expectEntries(wy.bodies[0].inertia, Vec3(0, rx * (P / I - dP_dI) / I, 0), kDerivative, "domega/dI");
  expectEntries(wy.materials[0].elasticity, -rx * P / I / (1 + e), kDerivative, "domega/de");
  Reliability r;
  const StateSeed seed = seedOf(0, Instant::at(0.37), 8);
  adjoint(m, std::span(&seed, 1), &r);
  EXPECT_FALSE(r.reliable);
  EXPECT_NE(r.message.find("joint law"), std::string::npos) << r.message;
}

Body rowBall(const char* name, double x, double v) { return makeBall(name, 0.1, {x, 0, 0}, {v, 0, 0}); }

void expectSpeeds(const Scene& s, const Vec3& expected) {
  const Motion m = play(s, 0.5);
  ASSERT_EQ(m.events.size(), 1u) << m.describeEvent(0);
  EXPECT_EQ(m.events[0].contacts.size(), 2u);
  const Vec3 found(m.stateAt(0, 0.5).velocity.x(), m.stateAt(1, 0.5).velocity.x(), m.stateAt(2, 0.5).velocity.x());
  expectEntries(found, expected, kState, "speeds");
  for (int b = 0; b < 3; ++b)
    expectEntries(m.stateAt(b, 0.5).velocity.tail<2>(), Vec2::Zero().eval(), kState, "across");
}

// Contacts of a row solved together: 2 P1 - P2 = (1 + e) v, 2 P2 - P1 = 0.
TEST(Joint, BallRunsIntoTwoThatTouch) {
  for (double e : {1.0, 0.5, 0.0}) {
    SCOPED_TRACE(e);
    const double p = (1 + e) / 3;
    expectSpeeds(makeScene(Vec3::Zero(), e, 0, {rowBall("a", -0.5, 1), rowBall("b", 0, 0), rowBall("c", 0.2, 0)}),
                 {1 - 2 * p, p, p});
  }
}

// A millionth of a metre is enough for one after another.
TEST(Joint, BallRunsIntoTwoThatAreApart) {
  const Motion m = play(
      makeScene(Vec3::Zero(), 1, 0, {rowBall("a", -0.5, 1), rowBall("b", 0, 0), rowBall("c", 0.2 + 1e-6, 0)}), 0.5);
  ASSERT_EQ(m.events.size(), 2u);
  for (int b = 0; b < 3; ++b)
    expectEntries(m.stateAt(b, 0.5).velocity, Vec3(b == 2 ? 1 : 0, 0, 0), kState, "speeds");
}

TEST(Joint, BallIsStruckFromBothSides) {
  for (double e : {1.0, 0.5, 0.0}) {
    SCOPED_TRACE(e);
    expectSpeeds(makeScene(Vec3::Zero(), e, 0, {rowBall("a", -0.5, 1), rowBall("b", 0, 0), rowBall("c", 0.5, -1)}),
                 {-e, 0, e});
  }
}

// A ball on the floor that is struck from above is held by the floor.
TEST(Joint, BallBetweenFloorAndAnotherBall) {
  const Scene s = makeScene(Vec3::Zero(), 0.5, 0,
                            {makeBall("low", 0.1, {0, 0, 0.1}), makeBall("high", 0.1, {0, 0, 0.6}, {0, 0, -1}),
                             makePlane("floor", Vec3::UnitZ(), 0)});
  const Motion m = play(s, 0.5);
  ASSERT_GE(m.events.size(), 1u);
  EXPECT_EQ(m.events[0].contacts.size(), 2u) << m.describeEvent(0);
  // low: P_floor - P_balls = 0; high: -1 + P_balls = e
  expectEntries(m.stateAt("high", 0.5).velocity.z(), 0.5, kState, "high");
  expectEntries(m.stateAt("low", 0.5).velocity.z(), 0, kState, "low");
}

// A ball strikes a block that rests on the floor, anywhere on its top: the floor gives the block no speed at all, so the
// ball bounces as off the ground, and rubs as on it. Struck straight down, or aslant where the floor is rough enough.
TEST(Joint, ABlockAtRestThatIsStruckStays) {
  constexpr double e = 0.3, mu = 0.25, fall = 3;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Body block = makeBox("block", {0.2, 0.3, 0.1}, {0, 0, 0.05}), floor = makePlane("floor", Vec3::UnitZ(), 0);
    block.mass = 1.3, floor.material = "rough";
    const Vec3 along = seed % 2 ? Vec3(3.6, 4.8, 0) : Vec3(Vec3::Zero());  // so fast that it slides
    const Vec3 struck(random.in(-0.06, 0.06), random.in(-0.11, 0.11), 0.1);
    Body ball = makeBall("ball", 0.05, struck + 0.1 * Vec3(-along.x(), -along.y(), fall) + Vec3(0, 0, 0.05 - 0.04905),
                         along + Vec3(0, 0, -(fall - 0.981)));
    Scene s = makeScene({0, 0, -9.81}, e, mu, {block, ball, floor});
    s.materials.push_back(makeMaterial("rough", e, 1));
    const Motion m = play(s, 0.15);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    EXPECT_EQ(m.events[1].contacts.size(), 5u) << m.describeEvent(1);
    const BodyState stays = m.stateAfter(1, 0), bounces = m.stateAfter(1, 1);
    EXPECT_TRUE(stays.velocity.isZero(0) && stays.angular_velocity.isZero(0));
    EXPECT_EQ(m.stateAt(0, 0.15).position, block.position);
    const Vec3 before = m.stateBefore(1, 1).velocity;
    const Vec3 rubbed = along - mu * (1 + e) * -before.z() * along.normalized();
    expectEntries(before, Vec3(along.x(), along.y(), -fall), kState, "before");
    expectEntries(bounces.velocity, Vec3(rubbed.x(), rubbed.y(), e * fall), kState, "after");
  }
}

}  // namespace
}  // namespace carom
