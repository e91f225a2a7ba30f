// SPDX-License-Identifier: MIT
// First impacts whose time is known in closed form, for every pair of shapes and features: with a fixed and with a
// flying partner, seen from any direction, in either order of the bodies.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

constexpr double kTime = 1e-13;  // s

Body turned(Body b, const Quat& q) {
  b.orientation = q;
  return b;
}

Quat about(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis)); }

/// `mover` meets `target` (at rest) at `time`, without gravity.
struct Meeting {
  const char* name;
  Body mover, target;
  double time;
  const char* features;  ///< of mover on target
};

std::vector<Meeting> meetings() {
  const Body brick = makeBox("target", {0.4, 0.4, 0.4}, Vec3::Zero());
  const auto ball = [](const Vec3& at, const Vec3& v) { return makeBall("mover", 0.1, at, v); };
  const double r2 = std::sqrt(2.0), r3 = std::sqrt(3.0), up = 0.75, tip = 0.15 * r3;
  const Quat on_corner = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
  const auto cube = [&](const Vec3& at) {
    return turned(makeBox("mover", {0.3, 0.3, 0.3}, at, {0, 0, -2}), on_corner);
  };
  const Body ridge = turned(makeBox("target", {0.2, 1, 0.2}, Vec3::Zero()), about(Vec3::UnitY(), std::numbers::pi / 4));
  const auto bar = [&](double across) {
    const Quat q = about(Vec3::UnitZ(), across) * about(Vec3::UnitX(), std::numbers::pi / 4);
    return turned(makeBox("mover", {1, 0.2, 0.2}, {0.03, 0.07, 1}, {0, 0, -2}), q);
  };
  return {
      {"ball on ball", ball({1, 0.06, 0.08}, {-2, 0, 0}), makeBall("target", 0.1, Vec3::Zero()),
       (1 - std::sqrt(0.04 - 0.01)) / 2, "ball on ball"},
      {"ball on face", ball({1, 0.1, 0.05}, {-2, 0, 0}), brick, (1 - 0.3) / 2, "ball on face +x"},
      {"ball on edge, straight", ball({1, 1, 0.05}, {-1, -1, 0}), brick, 1 - (0.2 + 0.1 / r2), "ball on edge +x+y"},
      {"ball on edge, past the face", ball({1, 0.25, 0}, {-1, 0, 0}), brick, 1 - (0.2 + std::sqrt(0.0075)),
       "ball on edge +x+y"},
      {"ball on corner, straight", ball({1, 1, 1}, {-1, -1, -1}), brick, 1 - (0.2 + 0.1 / r3), "ball on vertex +x+y+z"},
      {"ball on corner, past the edge", ball({1, 0.25, 0.25}, {-1, 0, 0}), brick, 1 - (0.2 + std::sqrt(0.005)),
       "ball on vertex +x+y+z"},
      {"vertex on face", cube({0.05, -0.06, up + 0.2}), brick, (up - tip) / 2, "vertex +x+y+z on face +z"},
      {"face on vertex", makeBox("mover", {0.4, 0.4, 0.4}, {0.03, 0.02, up + 0.2}, {0, 0, -2}),
       turned(makeBox("target", {0.3, 0.3, 0.3}, Vec3::Zero()), Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ())),
       (up - tip) / 2, "face -z on vertex +x+y+z"},
      {"edge on edge, square", bar(0), ridge, (1 - 0.2 * r2) / 2, "edge -y-z on edge +z-x"},
      {"edge on edge, askew", bar(0.6), ridge, (1 - 0.2 * r2) / 2, "edge"},
  };
}

Scene sceneOf(const Meeting& m, bool swapped) {
  Scene s = makeScene(Vec3::Zero(), 0.5, 0.3, {m.mover, m.target});
  if (swapped) std::swap(s.bodies[0], s.bodies[1]);
  return s;
}

void expectTime(const Scene& s, double time) {
  const Motion m = play(s, 2 * time, 1);
  ASSERT_GE(m.events.size(), 1u);
  EXPECT_TRUE(std::abs(m.events[0].time - time) <= kTime * toleranceScale())
      << m.describeEvent(0) << " at " << m.events[0].time << ", off by " << m.events[0].time - time;
  recordShare(std::abs(m.events[0].time - time) / kTime);
}

class FirstImpact : public ::testing::TestWithParam<Meeting> {};

TEST_P(FirstImpact, OnAFixedBody) {
  for (bool swapped : {false, true}) {
    Scene s = sceneOf(GetParam(), swapped);
    for (Body& b : s.bodies)
      if (b.name == "target") b = fixedBody(b);
    expectTime(s, GetParam().time);
  }
}

TEST_P(FirstImpact, HasItsFeatures) {
  const Motion m = play(sceneOf(GetParam(), false), 2, 1);
  ASSERT_FALSE(m.events.empty());
  EXPECT_NE(m.describeEvent(0).find(GetParam().features), std::string::npos) << m.describeEvent(0);
}

// Gravity and a common velocity pull both alike; a turn of everything changes nothing.
TEST_P(FirstImpact, InFlightAndFromAnyDirection) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    for (bool swapped : {false, true}) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      Random random(seed);
      Scene s = sceneOf(GetParam(), swapped);
      const Quat turn = random.rotation();
      const Vec3 shift = random.vec(1), drift = random.vec(2);
      s.gravity = random.vec(10);
      for (Body& b : s.bodies) {
        b.position = shift + turn * b.position;
        b.orientation = (turn * b.orientation).normalized();
        b.velocity = drift + turn * b.velocity;
      }
      expectTime(s, GetParam().time);
    }
}

INSTANTIATE_TEST_SUITE_P(Pairs, FirstImpact, ::testing::ValuesIn(meetings()), [](const auto& row) {
  std::string name = row.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

void PrintTo(const Meeting& row, std::ostream* out) { *out << row.name; }

TEST(FirstImpactOnPlane, Ball) {
  const Vec3 n = Vec3(1, 2, 2) / 3;
  const Body slope = makePlane("slope", n, 0.3), ball = makeBall("ball", 0.1, {1, 1, 1}, {0.3, -0.2, -0.5});
  for (bool swapped : {false, true}) {
    Scene s = makeScene(Vec3::Zero(), 0.5, 0, {ball, slope});
    if (swapped) std::swap(s.bodies[0], s.bodies[1]);
    const double height = n.dot(ball.position) - 0.3 - 0.1, fall = -n.dot(ball.velocity);
    expectTime(s, height / fall);
    s.gravity = {0, 0, -9.81};
    const double g = 9.81 * n.z();
    expectTime(s, (-fall + std::sqrt(fall * fall + 2 * g * height)) / g);
  }
}

TEST(FirstImpactOnPlane, ThrownUpBall) {
  const double v = 6, h = 0.4;
  const Scene s = makeScene({0, 0, -9.81}, 0.5, 0,
                            {makeBall("ball", 0.1, {0, 0, h + 0.1}, {1, 0, v}), makePlane("floor", Vec3::UnitZ(), 0)});
  expectTime(s, (v + std::sqrt(v * v + 2 * 9.81 * h)) / 9.81);
}

// A box that turns about its y axis at height h: the lower edge is at depth 0.5 sin + 0.1 cos = rho sin(angle + d).
TEST(FirstImpactOnPlane, TurningBox) {
  const double rho = std::hypot(0.5, 0.1), d = std::atan2(0.1, 0.5), spin = 2;
  for (double h : {0.2, 0.4, 0.5}) {
    SCOPED_TRACE(h);
    Body box = makeBox("box", {1, 0.3, 0.2}, {0, 0, h});
    box.angular_velocity = {0, spin, 0};
    expectTime(makeScene(Vec3::Zero(), 0.5, 0, {box, makePlane("floor", Vec3::UnitZ(), 0)}),
               (std::asin(h / rho) - d) / spin);
  }
}

TEST(FirstImpactOnPlane, BoxOnItsCorner) {
  Body box = turned(makeBox("box", {0.3, 0.4, 0.5}, {0, 0, 2}, {0, 0, -1.5}), Quat(0.8, 0.3, -0.4, 0.2).normalized());
  double lowest = 0;
  for (int v = 0; v < 8; ++v)
    lowest =
        std::min(lowest, (box.orientation * Vec3(v & 1 ? 0.15 : -0.15, v & 2 ? 0.2 : -0.2, v & 4 ? 0.25 : -0.25)).z());
  expectTime(makeScene(Vec3::Zero(), 0.5, 0, {box, makePlane("floor", Vec3::UnitZ(), 0)}), (2 + lowest) / 1.5);
}

// Thin and fast: nothing passes through.
TEST(FirstImpactAtSpeed, ThinBodiesDoNotPassThinWalls) {
  const Body wall = fixedBody(makeBox("wall", {0.002, 1, 1}, Vec3::Zero()));
  const Body card = makeBox("card", {0.001, 0.1, 0.1}, {-5, 0.1, 0.2}, {500, 0, 0});
  expectTime(makeScene(Vec3::Zero(), 0.5, 0.3, {card, wall}), (5 - 0.0005 - 0.001) / 500);
  const Body pellet = makeBall("pellet", 1e-3, {-5, 0.1, 0.2}, {1000, 0, 0});
  expectTime(makeScene(Vec3::Zero(), 0.5, 0.3, {pellet, wall}), (5 - 0.001 - 0.001) / 1000);
  // edge on, spinning
  Body disc = makeBox("disc", {0.1, 0.1, 0.001}, {-5, 0.1, 0.2}, {500, 0, 0});
  disc.angular_velocity = {0, 0, 200};
  const Motion m = play(makeScene(Vec3::Zero(), 0.5, 0.3, {disc, wall}), 0.02, 1);
  ASSERT_EQ(m.events.size(), 1u);
  EXPECT_GT(m.events[0].time, (5 - 0.05 * std::sqrt(2.0) - 0.001) / 500 - 1e-12);
  EXPECT_LT(m.events[0].time, (5 - 0.05 - 0.001) / 500 + 1e-12);
}

}  // namespace
}  // namespace carom
