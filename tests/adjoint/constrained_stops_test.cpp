// SPDX-License-Identifier: MIT
// Slips of several contacts that end at one instant, as those of a body that slides and turns: their derivatives there.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "adjoint/derivative/tangent.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/transposed.h"

namespace carom::held_stops {
namespace {

using namespace test;

Body lying(const Shape& shape, double radius, const Vec3& velocity, const Vec3& spin) {
  Body body = makeBall("body", radius, {-1, -0.4, radius}, velocity);
  body.shape = shape;
  body.orientation = Quat(0.7071067811865476, 0, 0.7071067811865476, 0);
  body.angular_velocity = spin;
  return body;
}

struct Column {
  const char* name;
  std::function<void(SceneTangent&)> set;
};
std::vector<Column> columns(std::size_t body) {
  return {{"velocity.x", [=](SceneTangent& d) { d.bodies[body].velocity.x() = 1; }},
          {"velocity.y", [=](SceneTangent& d) { d.bodies[body].velocity.y() = 1; }},
          {"angular_velocity.z", [=](SceneTangent& d) { d.bodies[body].angular_velocity.z() = 1; }},
          {"friction", [](SceneTangent& d) { d.materials[0].friction = 1; }}};
}

// A capsule slides, turns and comes to roll: against an independent reference of 60 digits.
TEST(ConstrainedStops, ACapsuleThatComesToRoll) {
  for (const bool first : {true, false}) {
    Body capsule = lying(Capsule{0.05, 0.3}, 0.05, {0.5, 1.6, 0}, {0, 0, 1});
    capsule.mass = 0.3;
    const Body floor = makePlane("floor", Vec3::UnitZ(), 0);
    const int b = first ? 0 : 1;
    const Motion m = playLasting(first ? makeScene({0, 0, -9.81}, 0.2, 0.3, {capsule, floor})
                                       : makeScene({0, 0, -9.81}, 0.2, 0.3, {floor, capsule}), 2);
    ASSERT_EQ(m.events.size(), 2u);
    expectEntries(m.events[1].time, 0.3253666683525629560597349, 1e-14, "sticks");
    const auto at = [&](const Column& c, double t) {
      SceneTangent d(*m.scene);
      c.set(d);
      DerivativeTape tape(m);
      return tangent(tape, d).at(b, Instant::at(t));
    };
    const std::vector<Column> by = columns(static_cast<std::size_t>(b));
    const std::size_t vx = 0, vy = 1, friction = 3;
    const auto expectPlane = [](const Vec3& found, double x, double y, const char* what) {
      expectEntries(found.head<2>(), Vec2(x, y), 1e-10, what, 10);
    };
    expectPlane(at(by[vx], 0.2).position, 0.1685504774160801, 0.014395945313451437, "x by vx at 0.2 s");
    expectPlane(at(by[vx], 2).position, 0.3055576367577871, -0.10558893153034166, "x by vx");
    expectPlane(at(by[vy], 2).position, -0.2502754351203793, 1.3201929911044652, "x by vy");
    expectPlane(at(by[friction], 2).position, 0.595490457427378, 0.333358592643408, "x by friction");
    expectPlane(at(by[vx], 0.6).velocity, 0.02518300563242481, -0.07784272800141301, "v by vx");
    expectPlane(at(by[vx], 0.6).angular_velocity, 1.5568545600282602, 0.5036601126484962, "w by vx");
    expectPlane(at(by[vy], 0.6).angular_velocity, -12.378558172106013, -3.5418689290067418, "w by vy");
    expectPlane(at(by[friction], 0.6).angular_velocity, -6.619176730097478, 12.246787536953846, "w by friction");
  }
}

// Against differences of motions, extrapolated.
TEST(ConstrainedStops, AreLimitsOfDifferences) {
  int compared = 0;
  for (int seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(static_cast<std::uint64_t>(seed));
    const double radius = random.in(0.04, 0.1), length = random.in(0.2, 0.5);
    const Vec3 velocity(random.in(-1, 1), random.in(-2, 2), 0), spin(random.in(-5, 5), random.in(-1, 1), random.in(-3, 3));
    const Shape shape = seed % 3 == 0   ? Shape(Capsule{radius, length})
                        : seed % 3 == 1 ? Shape(Cylinder{radius, length})
                                        : Shape(Box{{2 * radius, length, length}});
    const Body body = lying(shape, radius, velocity, seed % 3 == 2 ? Vec3(0, 0, spin.z()) : spin);
    const Scene scene = makeScene(downSlope(seed % 2 == 0 ? 0 : 3), 0, random.in(0.2, 0.5), {body, makePlane("floor", Vec3::UnitZ(), 0)});
    const double until = 2;
    const Motion m = playLasting(scene, until);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    DerivativeTape tape(m);
    for (const Column& c : columns(0)) {
      SCOPED_TRACE(c.name);
      SceneTangent d(scene);
      c.set(d);
      const auto difference = [&](double h) {
        const Motion above = playLasting(moved(scene, d, h), until), below = playLasting(moved(scene, d, -h), until);
        EXPECT_EQ(above.signature(), m.signature());
        EXPECT_EQ(below.signature(), m.signature());
        const BodyState a = above.stateAt(0, until), b = below.stateAt(0, until);
        return Vec3((a.position - b.position) / (2 * h));
      };
      const double h = 2e-5;
      const Vec3 expected = (4 * difference(h) - difference(2 * h)) / 3;
      const Vec3 found = tangent(tape, d).at(0, Instant::at(until)).position;
      expectEntries(found, expected, 2e-8, "place", std::max(1.0, expected.norm()));
      ++compared;
    }
    expectTransposed(m, static_cast<std::uint64_t>(seed), 1e-11);
  }
  RecordProperty("compared", compared);
}

}  // namespace
}  // namespace carom::held_stops
