// SPDX-License-Identifier: MIT
// Bodies that contacts hold on corners and edges, against quadratures and closed forms of the plane (g = 9.81 m/s^2):
// boxes that fall over an edge or rock on two, balls that roll over the edge of a table, a plate that slides and turns.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::held_ground_truths {
namespace {

using namespace test;

constexpr double kState = 1e-10;
const Vec3 kDown(0, 0, -9.81);
const double kHalfDiagonal = std::sqrt(0.1) / 2;          // m, of a box of 0.1 by 0.3
const double kCritical = std::atan2(0.1, 0.3);            // rad, the tilt at which its centre is above its edge

// Tilted about its edge along y, which is at the origin; the angle is that of its centre past the edge, towards x.
Body boxPastItsEdge(double angle, double depth) {
  Body box = makeBox("box", {0.1, depth, 0.3}, kHalfDiagonal * Vec3(std::sin(angle), 0, std::cos(angle)));
  box.orientation = Quat(Eigen::AngleAxisd(kCritical + angle, Vec3::UnitY()));
  return box;
}
Scene onFloor(double elasticity, double friction, Body body) {
  return makeScene(kDown, elasticity, friction, {std::move(body), makePlane("floor", Vec3::UnitZ(), 0)});
}
double anglePast(const Vec3& edge, const BodyState& s) {
  return std::atan2(s.position.x() - edge.x(), s.position.z() - edge.z());
}
int firstOf(const Motion& m, TransitionCause cause) {
  for (std::size_t e = 0; e < m.events.size(); ++e)
    if (m.events[e].cause == cause) return static_cast<int>(e);
  return -1;
}
double timeOf(const Motion& m, int event) { return m.events[static_cast<std::size_t>(event)].time; }

TEST(ConstrainedGroundTruths, ABoxFallsOverItsEdge) {
  for (const double depth : {0.05, 0.4}) {
    SCOPED_TRACE("depth " + std::to_string(depth));
    const Motion m = playLasting(onFloor(0, 0.5, boxPastItsEdge(0.1, depth)), 0.45);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.events.front().kind, EventKind::placed);
    EXPECT_EQ(m.world_lines[0].arcs[1].kind(), ArcKind::pivot);
    const BodyState falls = m.stateAt(0, 0.36456490849625);
    expectEntries(anglePast(Vec3::Zero(), falls), 0.6, kState, "angle");
    expectEntries(falls.angular_velocity, Vec3(0, 3.97370667337254, 0), kState, "spin");
    expectEntries(falls.position.norm(), kHalfDiagonal, 1e-12, "distance from the edge");
    const int slips = firstOf(m, TransitionCause::slips);
    ASSERT_GE(slips, 0);
    expectEntries(timeOf(m, slips), 0.42793001417882, kState, "slips at");
    const BodyState then = m.stateBefore(slips, 0);
    expectEntries(anglePast(Vec3::Zero(), then), 0.91135199849891, kState, "angle there");
    expectEntries(then.angular_velocity, Vec3(0, 5.96502496818649, 0), kState, "spin there");
    // friction pulled it back last, so its edge slips the way it falls
    const BodyState later = m.stateAt(0, 0.44);
    const Vec3 edge = later.position + later.orientation * Vec3(0.05, 0, -0.15);
    expectEntries(edge.z(), 0.0, 1e-12, "height of the edge");
    EXPECT_GT(edge.x(), 1e-6);
  }
}

// A quarter of a rocking is half of what is between two impacts; at each of them the spin falls to 1 - 3/2 sin^2.
TEST(ConstrainedGroundTruths, ABoxRocksToRest) {
  Body box = boxPastItsEdge(-0.5 * kCritical, 0.2);
  const Motion m = playLasting(onFloor(0, 1, box), 3);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  std::vector<int> lands;
  for (std::size_t e = 0; e < m.events.size(); ++e)
    if (m.events[e].counts()) lands.push_back(static_cast<int>(e));
  ASSERT_GT(lands.size(), 20u);
  expectEntries(timeOf(m, lands[0]), 0.19364753815740, kState, "first quarter");
  for (std::size_t k = 0; k < 20; ++k) {
    const double before = m.stateBefore(lands[k], 0).angular_velocity.y(),
                 after = m.stateAfter(lands[k], 0).angular_velocity.y();
    expectEntries(after / before, 0.85, kState, "impact " + std::to_string(k + 1));
  }
  const double amplitudes[] = {0.10420574766034, 0.07101632532456, 0.04949719494690, 0.03492953169200};
  for (std::size_t k = 0; k < 4; ++k) {
    const double middle = 0.5 * (timeOf(m, lands[k]) + timeOf(m, lands[k + 1]));
    const BodyState s = m.stateAt(0, middle);
    const double tilt = 2 * std::asin(std::abs(s.orientation.y()));
    expectEntries(tilt, amplitudes[k], kState, "amplitude " + std::to_string(k + 1));
    expectEntries(s.angular_velocity, Vec3(0, 0, 0), kState, "spin there");
  }
  const Arc& rest = m.world_lines[0].arcs.back();
  ASSERT_EQ(rest.kind(), ArcKind::rest);
  expectEntries(rest.start(), 1.78338113, 1e-4, "rests from");
  const BodyState end = m.stateAt(0, 3);
  // its first edge has not moved
  expectEntries(end.position, Vec3(-0.05, 0, 0.15), kState, "place");
  expectEntries(end.orientation.coeffs(), Quat::Identity().coeffs(), 1e-12, "orientation");
}

// All four corners carry what least norm gives them; against an integration of these equations in 30 digits.
TEST(ConstrainedGroundTruths, APlateSlidesAndTurns) {
  Body plate = makeBox("plate", {0.2, 0.2, 0.05}, {0, 0, 0.025}, {1, 0, 0});
  plate.angular_velocity = {0, 0, 5};
  const Motion m = playLasting(onFloor(0, 0.4, plate), 1);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  const int stops = firstOf(m, TransitionCause::sticks);
  ASSERT_GE(stops, 0);
  expectEntries(timeOf(m, stops), 0.270422006635048, kState, "stops at");
  EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::rest);
  const BodyState end = m.stateAt(0, 1);
  expectEntries(end.position, Vec3(0.138700948181895, -0.00332044979808656, 0.025), kState, "place");
  expectEntries(2 * std::asin(end.orientation.z()), 0.498130790861779, kState, "turned by");
  EXPECT_EQ(end.velocity, Vec3::Zero());
}

struct OverAnEdge {
  double speed, friction, angle, after, spin;
};

TEST(ConstrainedGroundTruths, ASlowBallRollsOverAnEdge) {
  for (const OverAnEdge& row : {OverAnEdge{0.2, 1, 0.78805675093654, 0.13433406177091, 9.93083055115967},
                                OverAnEdge{0.3, 0.5, 0.63718561700268, 0.08906497409847, 9.53936771244250}}) {
    SCOPED_TRACE("speed " + std::to_string(row.speed));
    Body ball = makeBall("ball", 0.05, {0.9, 0, 0.05}, {row.speed, 0, 0});
    ball.angular_velocity = {0, row.speed / 0.05, 0};
    const Motion m = playLasting(makeScene(kDown, 0, row.friction,
                                           {ball, fixedBody(makeBox("table", {2, 2, 0.75}, {0, 0, -0.375})),
                                            makePlane("floor", Vec3::UnitZ(), -0.75)}),
                                 1.2);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const int leaves = firstOf(m, TransitionCause::leaves), slips = firstOf(m, TransitionCause::slips),
              lifts = firstOf(m, TransitionCause::lifts);
    ASSERT_GE(leaves, 0);
    ASSERT_GT(slips, leaves);
    ASSERT_GT(lifts, slips);
    expectEntries(timeOf(m, leaves), 0.1 / row.speed, kState, "at the edge");
    expectEntries(timeOf(m, slips) - timeOf(m, leaves), row.after, kState, "slips after");
    const BodyState then = m.stateBefore(slips, 0);
    expectEntries(anglePast({1, 0, 0}, then), row.angle, kState, "angle there");
    expectEntries(then.angular_velocity, Vec3(0, row.spin, 0), kState, "spin there");
    expectEntries((m.stateBefore(lifts, 0).position - Vec3(1, 0, 0)).norm(), 0.05, 1e-12, "distance from the edge");
    EXPECT_EQ(m.world_lines[0].arcs.back().kind(), ArcKind::roll);
  }
}

}  // namespace
}  // namespace carom::held_ground_truths
