// SPDX-License-Identifier: MIT
// Balls where no face alone holds them, against closed forms (g = 9.81 m/s^2): over the edge of a table, and between the
// two sides of a V.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::balls_in_corners {
namespace {

using namespace test;

constexpr double kState = 1e-12;
constexpr double kGravity = 9.81;
const Vec3 kDown(0, 0, -kGravity);

/// The integral of f from a to b, by Gauss' rule of 5 nodes on 200 stretches.
template <class F>
double integral(double a, double b, const F& f) {
  constexpr double at[] = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  constexpr int kStretches = 200;
  const double half = 0.5 * (b - a) / kStretches;
  double sum = 0;
  for (int k = 0; k < kStretches; ++k) {
    const double middle = a + (2 * k + 1) * half;
    sum += weight[0] * f(middle);
    for (int i : {1, 2}) sum += weight[i] * (f(middle - half * at[i]) + f(middle + half * at[i]));
  }
  return half * sum;
}

/// Where f, which is above 0 at a and falls, is 0.
template <class F>
double rootOf(double a, double b, const F& f) {
  for (int i = 0; i < 200; ++i) (f(0.5 * (a + b)) > 0 ? a : b) = 0.5 * (a + b);
  return 0.5 * (a + b);
}

/// A ball that comes to an edge at speed v, at an angle phi past the vertical above the edge. It turns about the edge
/// without slip, phi'^2 = v^2/r^2 + 10/7 a (1 - cos phi) with a = g/r, until 2/7 a sin phi = mu (a cos phi - phi'^2); then
/// w = phi'^2 obeys dw/dphi = 2 mu w + 2 a (sin phi - mu cos phi), and where w = a cos phi it lifts off. Without friction
/// all of it is the second part.
class OverAnEdge {
 public:
  OverAnEdge(double speed, double friction, double radius) : mu_(friction), a_(kGravity / radius) {
    w0_ = speed * speed / (radius * radius);
    const double k = 1 + 4 * mu_ * mu_;
    A_ = 2 * a_ * (2 * mu_ * mu_ - 1) / k, B_ = -6 * mu_ * a_ / k;
    if (mu_ > 0)
      slips_at = rootOf(0, 1.5, [&](double p) {
        return mu_ * (a_ * std::cos(p) - beforeSlip(p)) - 2 * a_ / 7 * std::sin(p);
      });
    C_ = (beforeSlip(slips_at) - A_ * std::cos(slips_at) - B_ * std::sin(slips_at)) * std::exp(-2 * mu_ * slips_at);
    lifts_at = rootOf(slips_at, 1.5, [&](double p) { return a_ * std::cos(p) - inSlip(p); });
    slips_after = integral(0, slips_at, [&](double p) { return 1 / std::sqrt(beforeSlip(p)); });
    lifts_after = slips_after + integral(slips_at, lifts_at, [&](double p) { return 1 / std::sqrt(inSlip(p)); });
    turns = std::sqrt(inSlip(lifts_at));
    spin = (mu_ > 0 ? std::sqrt(beforeSlip(slips_at)) : 0) + integral(slips_at, lifts_at, [&](double p) {
             return 2.5 * mu_ * (a_ * std::cos(p) - inSlip(p)) / std::sqrt(inSlip(p));
           });
  }

  double slips_at = 0, lifts_at = 0;        // rad
  double slips_after = 0, lifts_after = 0;  // s from the edge on
  double turns = 0, spin = 0;               // rad/s where it lifts off: phi', and of the ball

 private:
  double beforeSlip(double p) const { return w0_ + (mu_ > 0 ? 10 * a_ / 7 : 2 * a_) * (1 - std::cos(p)); }
  double inSlip(double p) const { return A_ * std::cos(p) + B_ * std::sin(p) + C_ * std::exp(2 * mu_ * p); }

  double mu_, a_, w0_ = 0, A_ = 0, B_ = 0, C_ = 0;
};

struct Approach {
  double speed, friction;
};

int firstOf(const Motion& m, TransitionCause cause) {
  for (std::size_t e = 0; e < m.events.size(); ++e)
    if (m.events[e].cause == cause) return static_cast<int>(e);
  return -1;
}

TEST(BallsInCorners, ASlowBallTurnsAboutTheEdgeOfATableAndLiftsOff) {
  constexpr double r = 0.05, table = 0.75, length = 0.1;
  for (const Approach& row : {Approach{0.2, 1}, {0.3, 0.5}, {0.02, 0.3}, {0.5, 0.2}, {0.2, 5}, {0.2, 0}, {0.6, 0}}) {
    SCOPED_TRACE("speed " + std::to_string(row.speed) + ", friction " + std::to_string(row.friction));
    const OverAnEdge truth(row.speed, row.friction, r);
    const double comes = length / row.speed;
    Body ball = makeBall("ball", r, {1 - length, 0, r}, {row.speed, 0, 0});
    ball.angular_velocity = {0, row.friction > 0 ? row.speed / r : 0, 0};
    const Motion m = playLasting(makeScene(kDown, 0, row.friction,
                                           {ball, fixedBody(makeBox("table", {2, 2, table}, {0, 0, -table / 2})),
                                            makePlane("floor", Vec3::UnitZ(), -table)}),
                                 comes + 1);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const int leaves = firstOf(m, TransitionCause::leaves), slips = firstOf(m, TransitionCause::slips),
              lifts = firstOf(m, TransitionCause::lifts);
    ASSERT_GE(leaves, 0);
    ASSERT_GT(lifts, leaves);
    expectEntries(m.events[static_cast<std::size_t>(leaves)].time, comes, kState, "comes to the edge");
    if (row.friction > 0) {
      ASSERT_EQ(slips, leaves + 1);
      EXPECT_EQ(m.world_lines[0].arcs[static_cast<std::size_t>(slips)].kind(), ArcKind::pivot);
      expectEntries(m.events[static_cast<std::size_t>(slips)].time - comes, truth.slips_after, kState, "slips after");
      const Vec3 out(std::sin(truth.slips_at), 0, std::cos(truth.slips_at));
      expectEntries(m.stateBefore(slips, 0).position, Vec3(Vec3(1, 0, 0) + r * out), kState, "slips at");
    }
    const BodyState off = m.stateAfter(lifts, 0);
    const Vec3 out(std::sin(truth.lifts_at), 0, std::cos(truth.lifts_at)), along(out.z(), 0, -out.x());
    const Vec3 place = Vec3(1, 0, 0) + r * out, velocity = r * truth.turns * along;
    expectEntries(m.events[static_cast<std::size_t>(lifts)].time - comes, truth.lifts_after, kState, "lifts off after");
    expectEntries(off.position, place, kState, "lifts off at");
    expectEntries(off.velocity, velocity, kState, "velocity there");
    expectEntries(off.angular_velocity, Vec3(0, truth.spin, 0), kState, "spin there");
    const std::optional<int> lands = m.findImpact(0, 1, 2);
    ASSERT_TRUE(lands);
    const double height = place.z() - r + table;
    const double falls = (velocity.z() + std::sqrt(velocity.z() * velocity.z() + 2 * kGravity * height)) / kGravity;
    const BodyState landed = m.stateBefore(*lands, 0);
    expectEntries(landed.position, Vec3(place.x() + velocity.x() * falls, 0, r - table), kState, "lands at");
  }
}

constexpr double kRadius = 0.1;

/// A ball that touches both sides of a V, whose normals are so far above the horizontal.
Scene inAV(double angle, double friction, const Vec3& spin) {
  const double c = std::cos(angle), s = std::sin(angle);
  Body ball = makeBall("ball", kRadius, {0, 0, kRadius / s});
  ball.angular_velocity = spin;
  return makeScene(kDown, 0.5, friction, {ball, makePlane("left", {c, 0, s}, 0), makePlane("right", {-c, 0, s}, 0)});
}

// It spins on the spot about the line of a V of 45 degrees: the sides push with m g (1 +- mu)/(sqrt 2 (1 + mu^2)).
TEST(BallsInCorners, ABallThatSpinsInAVComesToRest) {
  for (const double friction : {0.1, 0.5, 0.9})
    for (const double spin : {3.0, -20.0}) {
      SCOPED_TRACE("friction " + std::to_string(friction) + ", spin " + std::to_string(spin));
      const double brakes = 2.5 * std::sqrt(2) * friction * kGravity / ((1 + friction * friction) * kRadius);
      const double stops = std::abs(spin) / brakes, turn = 0.5 * spin * stops;
      const Motion m = playLasting(inAV(std::acos(-1.0) / 4, friction, {0, spin, 0}), stops + 1);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      ASSERT_EQ(m.events.size(), 2u);
      EXPECT_EQ(m.events[0].kind, EventKind::placed);
      EXPECT_EQ(m.events[1].cause, TransitionCause::sticks);
      expectEntries(m.events[1].time, stops, kState, "stops");
      EXPECT_EQ(m.world_lines[0].arcs[1].kind(), ArcKind::slide);
      EXPECT_EQ(m.world_lines[0].arcs[2].kind(), ArcKind::rest);
      for (int i = 0; i <= 20; ++i) {
        const double t = std::min(0.05 * i, 1.0) * (stops + 1), left = std::max(0.0, 1 - t / stops);
        const BodyState now = m.stateAt(0, t);
        expectEntries(now.position, Vec3(0, 0, kRadius * std::sqrt(2)), kState, "stays where it is");
        expectEntries(now.velocity, Vec3::Zero().eval(), kState, "velocity");
        expectEntries(now.angular_velocity, Vec3(0, spin * left, 0), kState, "spin");
        const double turned = 0.5 * turn * (1 - left * left);
        expectEntries(now.orientation.toRotationMatrix(),
                      Quat(std::cos(turned), 0, std::sin(turned), 0).toRotationMatrix(), kState, "orientation");
      }
    }
}

// It spins across the line of the V, slides along it, and rolls on in the end: both sides push with m g/(2 sin), and the
// slip v + r w sin slows down by mu g (1/sin + 5/2 sin).
TEST(BallsInCorners, ABallThatSpinsAcrossAVRollsAlongIt) {
  for (const auto& [angle, friction] : {std::pair{1.05, 0.6}, {1.3, 0.3}, {0.8, 0.1}, {0.8, 0.5}}) {
    SCOPED_TRACE("angle " + std::to_string(angle) + ", friction " + std::to_string(friction));
    constexpr double spin = 20;
    const double sine = std::sin(angle), slips = friction * kGravity * (1 / sine + 2.5 * sine);
    const double rolls = kRadius * spin * sine / slips, along = -friction * kGravity * rolls / sine;
    const Motion m = playLasting(inAV(angle, friction, {spin, 0, 0}), rolls + 1);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 2u);
    EXPECT_EQ(m.events[1].cause, TransitionCause::sticks);
    expectEntries(m.events[1].time, rolls, kState, "rolls from");
    // with less friction than that both sides do not stick without pushing against each other
    if (friction > 1 / std::tan(angle)) {
      EXPECT_EQ(m.world_lines[0].arcs[2].kind(), ArcKind::roll);
    }
    const BodyState end = m.stateAt(0, rolls + 1);
    expectEntries(end.position, Vec3(0, along * (0.5 * rolls + 1), kRadius / sine), kState, "place");
    expectEntries(end.velocity, Vec3(0, along, 0), kState, "velocity");
    expectEntries(end.angular_velocity, Vec3(-along / (kRadius * sine), 0, 0), kState, "spin");
  }
}

// A ball rolls straight at a wall, climbs a little and lands with some spin: nothing but the friction of the floor presses
// it against the wall. It slips on both, with N_floor (1 + mu^2) = m g and N_wall = mu N_floor, until its spin is used up.
TEST(BallsInCorners, FrictionPressesABallAgainstAWall) {
  constexpr double kFriction = 0.1;
  Body ball = makeBall("ball", kRadius, {0, 0, kRadius}, {0.35, 0, 0});
  ball.angular_velocity = {0, 9, 0};
  const Scene scene = makeScene(kDown, 0, kFriction, {ball, makePlane("floor", Vec3::UnitZ(), 0),
                                                      makePlane("wall", -Vec3::UnitX(), -2 * kRadius)});
  const Motion m = playLasting(scene, 3);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  const std::vector<Arc>& arcs = m.world_lines[0].arcs;
  ASSERT_EQ(arcs.back().kind(), ArcKind::rest);
  const Arc& slips = arcs[arcs.size() - 2];
  const double slowing = 2.5 * kFriction * (1 + kFriction) * kGravity / ((1 + kFriction * kFriction) * kRadius);
  const Vec3 spin = slips.kinematicsAt(slips.start()).w;
  EXPECT_GT(spin.y(), 1);
  expectEntries(arcs.back().start() - slips.start(), spin.y() / slowing, kState, "time to rest");
  const double half = 0.5 * (slips.start() + arcs.back().start());
  const Kinematics middle = slips.kinematicsAt(half);
  expectEntries(middle.w, Vec3(0, 0.5 * spin.y(), 0), kState, "spin halfway");
  expectEntries(middle.x, Vec3(kRadius, 0, kRadius), kState, "place");
}

}  // namespace
}  // namespace carom::balls_in_corners
