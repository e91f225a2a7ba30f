// SPDX-License-Identifier: MIT
// Slips that begin from none, or from what is left of rounding: every kind of path goes on along the slope (11.6), as it
// does from a slip of exactly 0, and never into what it is on. Balls and blocks that an impact stops on a slope too steep
// for them have closed forms, for their derivatives too.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "adjoint/derivative/adjoint.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/transposed.h"

namespace carom::beginning_slips {
namespace {

using namespace test;

constexpr double kRadius = 0.1;

struct Kind {
  const char* name;
  Shape shape;
  Vec3 axis;      // of the shape, up to z
  double height;  // of its centre
  bool rolls;     // across its axis, or any way
};
std::vector<Kind> kinds() {
  return {{"ball", Sphere{kRadius}, Vec3::UnitZ(), kRadius, true},
          {"block", Box{{0.4, 0.3, 0.2}}, Vec3::UnitZ(), 0.1, false},
          {"cylinder", Cylinder{kRadius, 0.3}, Vec3::UnitY(), kRadius, true},
          {"capsule", Capsule{kRadius, 0.3}, Vec3::UnitY(), kRadius, true},
          {"disc", Cylinder{0.2, 0.1}, Vec3::UnitZ(), 0.05, false}};
}

// At the contact it slips by `slip`; if it can roll, it rolls beside.
Scene sceneOf(const Kind& kind, double degrees, double friction, double rolling, const Vec3& slip, bool floor_first) {
  Body body = makeBall("body", kRadius, {0, 0, kind.height}, slip);
  body.shape = kind.shape;
  body.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), kind.axis);
  if (kind.rolls) {
    body.velocity += rolling * Vec3::UnitX();
    body.angular_velocity = rolling / kRadius * Vec3::UnitY();
  }
  const Body floor = makePlane("floor", Vec3::UnitZ(), 0);
  return floor_first ? makeScene(downSlope(degrees), 0, friction, {floor, body})
                     : makeScene(downSlope(degrees), 0, friction, {body, floor});
}

// Slips so slow that nobody can tell them from rounding: the motion is that without slip, but for as much as they move it.
TEST(BeginningSlips, GoOnAsFromNone) {
  const double duration = 1;
  int cases = 0;
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(static_cast<std::uint64_t>(seed));
    for (const Kind& kind : kinds()) {
      SCOPED_TRACE(kind.name);
      const double degrees = random.below(4) == 0 ? 0 : random.in(1, 60), friction = random.in(0.02, 0.6);
      const double rolling = random.below(2) == 0 ? 0 : random.in(-1, 1);
      const bool floor_first = random.below(2) == 0;
      const Motion none = playLasting(sceneOf(kind, degrees, friction, rolling, Vec3::Zero(), floor_first), duration);
      ASSERT_EQ(none.status, MotionStatus::complete) << none.message;
      const int body = floor_first ? 1 : 0;
      for (const double size : {1e-300, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9}) {
        SCOPED_TRACE("slip " + std::to_string(std::log10(size)));
        const double angle = random.in(0, 2 * std::numbers::pi);
        const Vec3 slip = size * Vec3(std::cos(angle), std::sin(angle), 0);
        const Motion m = playLasting(sceneOf(kind, degrees, friction, rolling, slip, floor_first), duration);
        ++cases;
        ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
        for (const double t : {0.3, 1.0}) {
          const BodyState found = m.stateAt(body, t), expected = none.stateAt(body, t);
          const double allowed = 1e-12 + 20 * size;
          expectEntries(found.position, expected.position, allowed, "position");
          expectEntries(found.velocity, expected.velocity, allowed, "velocity");
          EXPECT_LE(std::abs(found.position.z() - kind.height), 1e-12);
        }
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
  RecordProperty("cases", cases);
}

// Thrown at a floor without bounce, so that it sticks: of its slip it keeps nothing, of its velocity along the floor
// 1/(1 + k), 1/k = m r^2/I. Gravity, which is too steep for the friction, goes on along x.
struct Thrown {
  long double velocity[3], gravity[3], friction, height;
};
std::array<long double, 2> placeOf(const Thrown& in, long double share, long double duration) {
  const long double g = -in.gravity[2], fall = -in.velocity[2];
  const long double t = (std::sqrt(fall * fall + 2 * g * in.height) - fall) / g, rest = duration - t;
  const long double slope = std::hypot(in.gravity[0], in.gravity[1]), slides = 1 - in.friction * g / slope;
  std::array<long double, 2> place{};
  for (const std::size_t i : {0u, 1u}) {
    place[i] = in.velocity[i] * t + in.gravity[i] * t * t / 2 + share * (in.velocity[i] + in.gravity[i] * t) * rest +
               in.gravity[i] * slides * rest * rest / 2;
  }
  return place;
}

class AfterAStick : public ::testing::TestWithParam<int> {};

TEST_P(AfterAStick, SlipsBeginAlongTheSlope) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  for (const bool is_ball : {true, false}) {
    SCOPED_TRACE(is_ball ? "ball" : "block");
    const double share = is_ball ? 5.0 / 7 : 0, duration = 2;
    const double friction = random.in(0.05, 0.3), steep = friction / (1 - share) * random.in(1.05, 3);
    const double height = random.in(0.1, 1), fall = random.in(0, 3);
    const Vec3 gravity = 9.81 * Vec3(steep, 0, -1).normalized();
    const double speed = std::sqrt(fall * fall - 2 * gravity.z() * height), until = (fall - speed) / gravity.z();
    const double angle = random.in(0, 2 * std::numbers::pi), sticks = 0.9 * friction * speed / (1 - share);
    const Vec3 along = random.in(0, 1) * sticks * Vec3(std::cos(angle), std::sin(angle), 0);
    const Vec3 velocity = along - Vec3(gravity.x() * until, 0, fall);
    const Quat turned = GetParam() % 2 == 0 ? random.rotation() : Quat::Identity();  // all of it
    Body body = is_ball ? makeBall("body", kRadius, {0, 0, kRadius + height}, velocity)
                        : makeBox("body", {0.4, 0.3, 0.2}, {0, 0, 0.1 + height}, velocity);
    body.position = turned * body.position, body.velocity = turned * velocity, body.orientation = turned;
    const Motion m = playLasting(
        makeScene(turned * gravity, 0, friction, {body, makePlane("floor", turned * Vec3::UnitZ(), 0)}), duration);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    Thrown in{{velocity.x(), velocity.y(), velocity.z()}, {gravity.x(), gravity.y(), gravity.z()}, friction, height};
    const auto place = placeOf(in, share, duration);
    const Vec3 found = turned.conjugate() * m.stateAt(0, duration).position;
    for (const int i : {0, 1}) {
      SCOPED_TRACE(i == 0 ? "x" : "y");
      expectEntries(found[i], static_cast<double>(place[static_cast<std::size_t>(i)]), 1e-12, "place");
      StateSeed seed;
      seed.body = 0, seed.at = Instant::at(duration);
      seed.position = turned * Vec3::Unit(i);
      Reliability reliability;
      const SceneGradient g = adjoint(m, std::span<const StateSeed>(&seed, 1), &reliability);
      if (is_ball) EXPECT_TRUE(reliability.reliable) << reliability.message;
      const auto by = [&](long double& number) {
        const long double value = number, h = 1e-6L;
        const auto at = [&](long double x) {
          number = x;
          return placeOf(in, share, duration)[static_cast<std::size_t>(i)];
        };
        const long double rate = (at(value + h) - at(value - h)) / (2 * h);
        number = value;
        return static_cast<double>(rate);
      };
      const Vec3 by_velocity = turned.conjugate() * g.bodies[0].velocity, by_gravity = turned.conjugate() * g.gravity;
      for (int j = 0; j < 3; ++j) {
        expectEntries(by_velocity[j], by(in.velocity[j]), 1e-9, "by the velocity");
        expectEntries(by_gravity[j], by(in.gravity[j]), 1e-9, "by gravity");
      }
      expectEntries(g.materials[0].friction, by(in.friction), 1e-9, "by the friction");
      expectEntries((turned.conjugate() * g.bodies[0].position).z(), by(in.height), 1e-9, "by the height");
    }
    expectEntries(found.z(), is_ball ? kRadius : 0.1, 1e-12, "height");
    expectTransposed(m, static_cast<std::uint64_t>(GetParam()));
  }
}
// What was found: a ball thrown straight at a slope of 3-4-5 went 3.8 m into it, with a derivative of 0.70 that was called
// reliable.
TEST(HandedSlips, ABallThrownStraightAtASlope) {
  const Body ball = makeBall("ball", 1, {1.2, 0, 1.6}, {-3, 0, -4});
  const Motion m = playLasting(makeScene({0, 0, -9.81}, 0, 0.2, {makePlane("slope", {0.6, 0, 0.8}, 0), ball}), 3);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  expectEntries(m.events[0].time, 0.175757092, 1e-8, "capture");
  expectEntries(m.stateAt(1, 3).position, Vec3(16.113913230, 0, -10.835434923), 1e-9, "place");
  StateSeed seed;
  seed.body = 1, seed.at = Instant::at(3), seed.position = Vec3::UnitX();
  const SceneGradient g = adjoint(m, std::span<const StateSeed>(&seed, 1));
  expectEntries(g.bodies[1].velocity.x(), 1.403, 1e-3, "by velocity.x");
  expectEntries(g.bodies[1].velocity.z(), -1.053, 1e-3, "by velocity.z");
}

INSTANTIATE_TEST_SUITE_P(Seeds, AfterAStick, ::testing::Range(0, 20));

}  // namespace
}  // namespace carom::beginning_slips
