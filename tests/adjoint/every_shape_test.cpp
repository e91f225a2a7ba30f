// SPDX-License-Identifier: MIT
// Impacts of every kind of shape: gradients against differences of high order, the transpose of equation 5.5, bodies in
// reverse order, and, where a shape touches the floor with swept points, the same motion with those.

#include <gtest/gtest.h>

#include <algorithm>

#include "adjoint/numeric/so3.hpp"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/offset_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"
#include "tests/support/swept_points.h"
#include "tests/support/transposed.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

const Quat kTurned = Quat(0.8, 0.3, -0.4, 0.2).normalized(), kOther = Quat(0.7, -0.1, 0.5, 0.3).normalized();

Body thrown(const char* name, const Shape& shape, const Vec3& position, const Vec3& velocity) {
  Body b = makeBall(name, 1, position, velocity);
  b.shape = shape;
  b.orientation = kTurned;
  b.angular_velocity = {2, -3, 1};
  return b;
}

Scene onFloor(const Shape& shape) {
  Scene s = makeScene({0.2, -0.1, -9.81}, 0.7, 0.3,
                      {thrown("body", shape, {0, 0, 0.6}, {1, 0.3, -1}), makePlane("floor", Vec3::UnitZ(), 0)});
  s.materials[0].tangential_elasticity = 0.2;
  return s;
}

// One runs into the other, in free space.
Scene pair(const Shape& a, const Shape& b) {
  Body other = thrown("other", b, {0.9, 0.08, 0.05}, {-0.2, 0.1, 0});
  other.orientation = kOther;
  other.angular_velocity = {-0.7, 1.1, 0.4};
  other.mass.reset();
  other.density = 300;
  Scene s = makeScene({0.1, 0.2, -0.5}, 0.6, 0.3, {thrown("body", a, {0, 0, 0}, {2.5, 0.2, 0.1}), other});
  s.materials[0].tangential_elasticity = 0.1;
  return s;
}

Shape wedge() {
  return Hull{
      convexHull(
          tetrahedron({-0.15, -0.12, -0.1}, {0.3, -0.1, -0.08}, {-0.1, 0.25, -0.1}, {-0.05, 0.02, 0.25}).vertices),
      1.1, ""};
}
Shape ring() { return Mesh{torusTriangles(0.22, 0.08, 11, 7).surface(), 0.9, ""}; }
Shape twoBalls() {
  return Compound{{{Sphere{0.12}, {-0.15, 0, 0}, Quat::Identity()}, {Sphere{0.08}, {0.15, 0.02, 0}, kOther}}};
}
Shape hammer() {
  return Compound{{{Cylinder{0.03, 0.4}, {0, 0, 0}, Quat::Identity()},
                   {Box{{0.1, 0.2, 0.08}}, {0.01, 0, 0.2}, kOther},
                   {Capsule{0.04, 0.1}, {0, 0.02, -0.2}, kTurned}}};
}

struct ShapeRow {
  const char* name;
  Scene scene;
};
std::ostream& operator<<(std::ostream& out, const ShapeRow& row) { return out << row.name; }

std::vector<ShapeRow> shapeRows() {
  return {{"two_balls_floor", onFloor(twoBalls())},
          {"capsule_floor", onFloor(Capsule{0.07, 0.3})},
          {"cylinder_floor", onFloor(Cylinder{0.15, 0.3})},
          {"hull_floor", onFloor(wedge())},
          {"mesh_floor", onFloor(ring())},
          {"hammer_floor", onFloor(hammer())},
          {"mesh_ball", pair(ring(), Sphere{0.2})},
          {"ball_mesh", pair(Sphere{0.2}, ring())},
          {"capsule_capsule", pair(Capsule{0.1, 0.4}, Capsule{0.15, 0.3})},
          {"capsule_box", pair(Capsule{0.1, 0.4}, Box{{0.3, 0.4, 0.5}})},
          {"cylinder_ball", pair(Cylinder{0.2, 0.3}, Sphere{0.2})},
          {"cylinder_box", pair(Cylinder{0.2, 0.3}, Box{{0.3, 0.4, 0.5}})},
          {"cylinder_cylinder", pair(Cylinder{0.2, 0.3}, Cylinder{0.15, 0.5})},
          {"cone_floor", onFloor(Cone{0.15, 0.3})},
          {"spire_floor", onFloor(Cone{0.08, 0.4})},
          {"cone_ball", pair(Cone{0.2, 0.3}, Sphere{0.2})},
          {"ball_cone", pair(Sphere{0.2}, Cone{0.25, 0.5})},
          {"cone_box", pair(Cone{0.2, 0.3}, Box{{0.3, 0.4, 0.5}})},
          {"box_cone", pair(Box{{0.3, 0.4, 0.5}}, Cone{0.25, 0.5})},
          {"cone_capsule", pair(Cone{0.2, 0.3}, Capsule{0.15, 0.3})},
          {"capsule_cone", pair(Capsule{0.1, 0.5}, Cone{0.25, 0.5})},
          {"cone_cylinder", pair(Cone{0.2, 0.3}, Cylinder{0.15, 0.5})},
          {"cylinder_cone", pair(Cylinder{0.2, 0.3}, Cone{0.25, 0.5})},
          {"cone_cone", pair(Cone{0.2, 0.3}, Cone{0.15, 0.5})},
          {"cone_hull", pair(Cone{0.2, 0.3}, wedge())},
          {"mesh_cone", pair(ring(), Cone{0.25, 0.5})},
          {"cone_compound", pair(Cone{0.2, 0.3}, Compound{{{Cone{0.1, 0.3}, {0.05, 0, 0}, kOther},
                                                           {Sphere{0.1}, {-0.1, 0.05, 0}, kTurned}}})},
          {"hull_hull", pair(wedge(), wedge())},
          {"mesh_mesh", pair(ring(), ring())},
          {"compound_compound", pair(twoBalls(), hammer())},
          {"compound_hull", pair(hammer(), wedge())}};
}

Motion playRow(const Scene& scene) {
  Motion m = play(scene, 1.5, 2);  // up to the second impact
  const double T = m.events.size() < 2 ? m.end : m.events[0].time + 0.6 * (m.events[1].time - m.events[0].time);
  return play(scene, T);
}

double readOff(const Motion& m, const Motion& about, const std::vector<StateSeed>& seeds) {
  double sum = 0;
  for (const StateSeed& seed : seeds) {
    const BodyState s = m.stateAt(seed.body, seed.at.time), o = about.stateAt(seed.body, seed.at.time);
    sum += seed.position.dot(s.position) + seed.velocity.dot(s.velocity) +
           seed.angular_velocity.dot(s.angular_velocity) +
           seed.orientation.dot(logSO3(s.orientation * o.orientation.conjugate()));
  }
  return sum;
}

class EveryShape : public ::testing::TestWithParam<ShapeRow> {};

// Central differences at h to 4h, weighted so that the error is of order h^8.
TEST_P(EveryShape, GradientIsTheLimitOfDifferences) {
  const Scene& scene = GetParam().scene;
  const Motion m = playRow(scene);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  ASSERT_FALSE(m.events.empty());
  EXPECT_NE(m.events[0].mode, ImpactMode::joint);
  Random random(61);
  std::vector<StateSeed> seeds;
  for (int b : movingBodies(scene)) seeds.push_back(randomSeed(b, Instant::at(m.end), random));
  const SceneGradient gradient = adjoint(m, seeds);
  for (int round = 0; round < 2; ++round) {
    const SceneTangent all = randomDirection(scene, random);
    for (const ControlRow& control : controlRows()) {
      SceneTangent d(scene);
      control.copy(d, all);
      const bool density = std::string(control.name) == "density";
      const double h = density ? 0.05 : 1e-4, weights[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
      double difference = 0;
      for (int k = 1; k <= 4; ++k)
        for (int sign : {-1, 1}) {
          const Motion there = play(moved(scene, d, sign * k * h), m.end);
          ASSERT_EQ(there.signature(), m.signature()) << control.name;
          difference += sign * weights[k - 1] / h * readOff(there, m, seeds);
        }
      const double found = gradient.dot(d);
      expectEntries(found, difference, 1e-9, std::string(control.name) + " of " + m.describeEvent(0),
                    std::max(1., std::abs(difference)));
    }
  }
}

TEST_P(EveryShape, TangentAndAdjointAreTransposed) {
  Scene scene = GetParam().scene;
  for (bool reverse : {false, true}) {
    if (reverse) std::reverse(scene.bodies.begin(), scene.bodies.end());
    const Motion m = playRow(scene);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE((reverse ? "reversed, seed " : "seed ") + std::to_string(seed));
      expectTransposed(m, seed);
    }
  }
}

TEST_P(EveryShape, OrderOfBodiesDoesNotMatter) {
  const Scene& scene = GetParam().scene;
  Scene turned = scene;
  std::reverse(turned.bodies.begin(), turned.bodies.end());
  const Motion m = playRow(scene), n = play(turned, m.end);
  ASSERT_EQ(m.events.size(), n.events.size());
  for (int b = 0; b < 2; ++b) {
    expectEntries(flatten(n.stateAt(1 - b, m.end)), flatten(m.stateAt(b, m.end)), 1e-11, "state");
    if (scene.bodies[static_cast<std::size_t>(b)].fixed) continue;
    for (int i = 0; i < 12; ++i) {
      const SceneGradient g = gradientOf(m, b, m.end, i), h = gradientOf(n, 1 - b, m.end, i);
      SceneGradient swapped(scene);
      swapped.gravity = h.gravity, swapped.materials = h.materials;
      swapped.bodies = {h.bodies[1], h.bodies[0]};
      expectEntries(flatten(swapped), flatten(g), 1e-10, "gradient", flatten(g).cwiseAbs().maxCoeff());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, EveryShape, ::testing::ValuesIn(shapeRows()),
                         [](const auto& row) { return std::string(row.param.name); });

bool touchesWithPoints(const Shape& shape) {
  if (const auto* c = std::get_if<Compound>(&shape))
    return std::all_of(c->parts.begin(), c->parts.end(), [](const auto& p) { return touchesWithPoints(p.shape); });
  return !std::holds_alternative<Cylinder>(shape) && !std::holds_alternative<Cone>(shape) &&
         !std::holds_alternative<Mesh>(shape);
}

// The offset bodies, which 50 digits confirm with swept points, through collision detection.
TEST(EveryShape, SweptPointsGiveTheSameMotionAndGradient) {
  int rows = 0;
  for (const OffsetScene& row : offsetScenes()) {
    const Scene scene = row.scene();
    if (!touchesWithPoints(scene.bodies[0].shape)) continue;
    SCOPED_TRACE(row.name);
    SweptPointContacts points(scene);
    OdeContacts ode(scene);
    const Motion m = simulate(scene, points, row.duration), n = simulate(scene, ode, row.duration);
    ASSERT_EQ(m.events.size(), n.events.size());
    rows += !m.events.empty();
    expectEntries(flatten(n.stateAt(0, row.duration)), flatten(m.stateAt(0, row.duration)), 1e-11, "state");
    for (int i = 0; i < 12; ++i) {
      const Eigen::VectorXd g = flatten(gradientOf(m, 0, row.duration, i));
      expectEntries(flatten(gradientOf(n, 0, row.duration, i)), g, 1e-10, "gradient of " + std::to_string(i),
                    g.cwiseAbs().maxCoeff());
    }
  }
  EXPECT_GE(rows, 9);
}

}  // namespace
}  // namespace carom
