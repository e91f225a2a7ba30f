// SPDX-License-Identifier: MIT
// Passes that just touch or just do not, bodies that fly side by side, and bodies that overlap or touch at the start.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adjoint/base/errors.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/ode_bridge/refusing.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

// By how much a pass clears, m; negative is a hit.
std::vector<double> clearances() {
  std::vector<double> all;
  for (double d : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) all.push_back(d), all.push_back(-d);
  return all;
}

// Hit or miss as the clearance says; a hit at `time`, within `tolerance`.
void expectPass(const Scene& s, double duration, double clearance, double time, double tolerance) {
  const Motion m = play(s, duration, 1);
  ASSERT_EQ(m.events.size(), clearance < 0 ? 1u : 0u) << (m.events.empty() ? "" : m.describeEvent(0));
  if (clearance > 0) return;
  EXPECT_TRUE(std::abs(m.events[0].time - time) <= tolerance) << m.events[0].time - time << " of " << tolerance;
  EXPECT_TRUE(m.events[0].margins.grazing > 0);
}

// Rounding of a coordinate (1e-16) moves a grazing contact by 1e-16 over the slope at which it is met.
double grazingTolerance(double radius, double reach) { return 1e-13 + 1e-15 * radius / reach; }

TEST(NearMiss, BallPassesBall) {
  for (double d : clearances()) {
    SCOPED_TRACE(d);
    const double R = 0.25, b = R + d, reach = std::sqrt(std::max(0.0, (R - b) * (R + b)));
    const Scene s =
        makeScene(Vec3::Zero(), 0.5, 0, {makeBall("a", 0.1, {-1, b, 0}, {2, 0, 0}), makeBall("b", 0.15, Vec3::Zero())});
    expectPass(s, 1, d, (1 - reach) / 2, grazingTolerance(R, reach));
  }
}

TEST(NearMiss, BallRisesToTheCeiling) {
  for (double d : clearances()) {
    SCOPED_TRACE(d);
    const double h = 0.8, g = 9.81, v = std::sqrt(2 * g * (h - d)), rest = std::sqrt(std::max(0.0, v * v - 2 * g * h));
    const Scene s =
        makeScene({0, 0, -g}, 0.5, 0,
                  {makeBall("ball", 0.1, {0, 0, 0.1}, {0.3, 0, v}), makePlane("ceiling", -Vec3::UnitZ(), -1.0)});
    expectPass(s, 0.6, d, (v - rest) / g, grazingTolerance(v, rest));
  }
}

TEST(NearMiss, BallPassesAnEdge) {
  for (double d : clearances()) {
    SCOPED_TRACE(d);
    const double r = 0.1, over = r + d, reach = std::sqrt(std::max(0.0, (r - over) * (r + over)));
    const Scene s = makeScene(Vec3::Zero(), 0.5, 0,
                              {makeBall("ball", r, {1, 0.05, 0.2 + over}, {-2, 0, 0}),
                               fixedBody(makeBox("step", {0.4, 0.4, 0.4}, Vec3::Zero()))});
    expectPass(s, 1, d, (1 - 0.2 - reach) / 2, grazingTolerance(r, reach));
  }
}

TEST(NearMiss, CornerPassesOverABox) {
  for (double d : clearances()) {
    SCOPED_TRACE(d);
    const double tip = 0.15 * std::sqrt(3.0);
    Body cube = makeBox("cube", {0.3, 0.3, 0.3}, {1, 0.05, 0.2 + tip + d}, {-2, 0, 0});
    cube.orientation = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
    const Scene s = makeScene(Vec3::Zero(), 0.5, 0, {cube, fixedBody(makeBox("step", {0.4, 0.4, 0.4}, Vec3::Zero()))});
    // an edge or face of the cube meets the step's edge a little before its lowest vertex would
    expectPass(s, 1, d, 0.4, 2 * std::abs(d) + 1e-13);
  }
}

TEST(NearMiss, EdgePassesOverARidge) {
  for (double d : clearances()) {
    SCOPED_TRACE(d);
    Body bar = makeBox("bar", {1, 0.2, 0.2}, {0, -1, 0.2 * std::sqrt(2.0) + d}, {0, 2, 0});
    bar.orientation = Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX()));
    Body ridge = makeBox("ridge", {0.2, 1, 0.2}, Vec3::Zero());
    ridge.orientation = Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()));
    expectPass(makeScene(Vec3::Zero(), 0.5, 0, {bar, fixedBody(ridge)}), 1, d, 0.25, 2 * std::abs(d) + 1e-13);
  }
}

// The corner of a box that turns in place comes down to rho at most.
TEST(NearMiss, TurningBoxOverAPlane) {
  for (double d : clearances()) {
    SCOPED_TRACE(d);
    const double rho = std::hypot(0.5, 0.1), h = rho + d, start = std::atan2(0.1, 0.5), spin = 2;
    Body box = makeBox("box", {1, 0.3, 0.2}, {0, 0, h});
    box.angular_velocity = {0, spin, 0};
    const Scene s = makeScene(Vec3::Zero(), 0.5, 0, {box, makePlane("floor", Vec3::UnitZ(), 0)});
    const double reach = std::sqrt(std::max(0.0, (rho - h) * (rho + h)));
    expectPass(s, 1, d, (std::asin(std::min(1.0, h / rho)) - start) / spin, grazingTolerance(rho, reach));
  }
}

TEST(SideBySide, EqualFlightsNeverTouch) {
  for (double gap : {1e-3, 1e-6, 1e-9, 0.0}) {
    SCOPED_TRACE(gap);
    const Vec3 v(3, 1, 20);
    const Scene s = makeScene({0, 0, -9.81}, 0.5, 0.3,
                              {makeBox("a", {0.2, 0.2, 0.2}, {0, 0, 10}, v),
                               makeBox("b", {0.2, 0.3, 0.2}, {0.2 + gap, 0, 10}, v), makeBall("c", 0.1, {0, 1, 10}, v),
                               makeBall("d", 0.1, {0.2 + gap, 1, 10}, v), makePlane("floor", Vec3::UnitZ(), 0)});
    const Motion m = play(s, 4);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_TRUE(m.events.empty()) << m.describeEvent(0);
  }
}

TEST(SideBySide, BoxesThatTurnAlikeNeverTouch) {
  Body a = makeBox("a", {0.2, 0.2, 0.2}, {0, 0, 0}), b = makeBox("b", {0.2, 0.2, 0.2}, {0, 0, 0.2 + 1e-6});
  a.angular_velocity = b.angular_velocity = {0, 0, 3};
  const Motion m = play(makeScene(Vec3::Zero(), 0.5, 0.3, {a, b}), 10);
  EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_TRUE(m.events.empty());
}

struct Start {
  const char* name;
  Body a, b;  ///< at rest, touching exactly; n points from b to a
  Vec3 n;
};

std::vector<Start> starts() {
  const Body floor = makePlane("floor", Vec3::UnitZ(), 0);
  Body corner = makeBox("cube", {0.3, 0.3, 0.3}, {0, 0, 0.15 * std::sqrt(3.0)});
  corner.orientation = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
  return {
      {"ball on plane", makeBall("a", 0.1, {0, 0, 0.1}), floor, Vec3::UnitZ()},
      {"ball on ball", makeBall("a", 0.1, {0, 0, 0.1}), makeBall("b", 0.2, {0, 0, -0.2}), Vec3::UnitZ()},
      {"ball on box", makeBall("a", 0.1, {0, 0, 0.1}), makeBox("b", {1, 1, 1}, {0.1, 0, -0.5}), Vec3::UnitZ()},
      {"box on plane", makeBox("a", {0.2, 0.2, 0.2}, {0, 0, 0.1}), floor, Vec3::UnitZ()},
      {"corner on plane", corner, floor, Vec3::UnitZ()},
      {"box on box", makeBox("a", {0.2, 0.2, 0.2}, {0, 0, 0.1}), makeBox("b", {1, 1, 1}, {0.1, 0, -0.5}),
       Vec3::UnitZ()},
  };
}

TEST(AtTheStart, OverlapIsRefused) {
  for (const Start& start : starts())
    for (double depth : {1e-6, 1e-3, 0.08}) {
      SCOPED_TRACE(std::string(start.name) + ", " + std::to_string(depth));
      Scene s = makeScene({0, 0, -9.81}, 0.5, 0, {start.a, start.b});
      s.bodies[0].position -= depth * start.n;
      try {
        playRefusing(s, 1);
        ADD_FAILURE() << "accepted";
      } catch (const InputError& error) {
        EXPECT_EQ(error.where(), "/bodies/1") << error.what();
        EXPECT_NE(error.message().find("overlapping by"), std::string::npos) << error.what();
        EXPECT_NE(error.message().find("'" + start.a.name + "' and '" + start.b.name + "'"), std::string::npos)
            << error.what();
      }
    }
}

TEST(AtTheStart, BodiesInsideOneAnotherAreRefused) {
  const Body small = makeBox("small", {0.1, 0.1, 0.1}, {0.1, 0, 0}), big = makeBox("big", {2, 2, 2}, Vec3::Zero());
  EXPECT_THROW(playRefusing(makeScene(Vec3::Zero(), 0.5, 0, {small, big}), 1), InputError);
  EXPECT_THROW(playRefusing(makeScene(Vec3::Zero(), 0.5, 0, {makeBall("ball", 0.1, {0.1, 0, 0}), fixedBody(big)}), 1),
               InputError);
  EXPECT_THROW(
      playRefusing(makeScene(Vec3::Zero(), 0.5, 0, {makeBall("a", 0.1, Vec3::Zero()), makeBall("b", 0.1, Vec3::Zero())}), 1),
      InputError);
}

TEST(AtTheStart, FixedBodiesMayOverlap) {
  const Scene s = makeScene(Vec3::Zero(), 0.5, 0,
                            {fixedBody(makeBox("a", {1, 1, 1}, Vec3::Zero())),
                             fixedBody(makeBox("b", {1, 1, 1}, {0.5, 0, 0})), makePlane("c", Vec3::UnitZ(), 0)});
  EXPECT_EQ(play(s, 1).status, MotionStatus::complete);
}

TEST(AtTheStart, TouchingIsAccepted) {
  for (const Start& start : starts()) {
    SCOPED_TRACE(start.name);
    Scene s = makeScene(Vec3::Zero(), 0.5, 0, {start.a, start.b});
    EXPECT_TRUE(play(s, 1).events.empty()) << "at rest";
    s.bodies[0].velocity = start.n;
    EXPECT_TRUE(play(s, 1).events.empty()) << "parting";
    s.bodies[0].velocity = -start.n;
    const Motion m = play(s, 1);
    ASSERT_FALSE(m.events.empty()) << "approaching";
    EXPECT_TRUE(m.events[0].time <= 1e-12) << m.events[0].time;
  }
}

}  // namespace
}  // namespace carom
