// SPDX-License-Identifier: MIT
// A kinematic body without velocity is ground, as a fixed one is: the same motions, impacts, rests and derivatives; but with
// respect to its own velocity, which is marked where something stays in contact with it.

#include <gtest/gtest.h>

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate_along.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"

namespace carom::still_kinematic {
namespace {

using namespace test;

constexpr double kState = 1e-12, kDerivative = 1e-11;

struct Case {
  const char* name;
  Scene fixed;
  double duration;
};

// Boxes, cylinders, meshes in place of planes, which cannot move; what is on them slides, rolls, settles, leaves, hits.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const DotProductScene& row : lastingScenes()) {
    const Scene scene = row.scene();
    const auto stands = [](const Body& b) { return b.fixed && !std::holds_alternative<Plane>(b.shape); };
    if (row.asked.empty() && std::ranges::any_of(scene.bodies, stands)) all.push_back({row.name, scene, row.duration});
  }
  const Vec3 down(0, 0, -9.81);
  const Body table = fixedBody(makeBox("table", {4, 4, 1}, {0, 0, -0.5})), next = fixedBody(makeBox("next", {4, 4, 1}, {4, 0, -0.5}));
  Body die = makeBox("die", {0.1, 0.1, 0.1}, {0, 0, 0.4}, {1, 0.3, 0});
  die.angular_velocity = {3, -5, 2}, die.orientation = Quat(0.8, 0.2, 0.4, 0.4);
  all.push_back({"die", makeScene(down, 0.3, 0.4, {die, table, next}), 2});
  all.push_back({"block over a seam", makeScene(down, 0, 0.1, {makeBox("block", {0.3, 0.2, 0.1}, {1.5, 0.1, 0.05}, {2, 0, 0}), table, next}), 2});
  Body ball = makeBall("ball", 0.1, {1.2, 0, 0.1}, {1.5, 0.2, 0});
  all.push_back({"ball over a seam", makeScene(down, 0, 0.3, {table, ball, next}), 2});
  all.push_back({"stopped", makeScene(down, 0.1, 0.5, {makeBall("ball", 0.1, {0, 0, 0.3}), table}), 2});
  return all;
}

Scene withKinematic(Scene scene) {
  for (Body& b : scene.bodies)
    if (b.fixed && !std::holds_alternative<Plane>(b.shape)) b.fixed = false, b.kinematic = true;
  return scene;
}

std::vector<StateSeed> seedsOf(const Motion& m, double time) {
  std::vector<StateSeed> seeds;
  for (std::size_t b = 0; b < m.scene->bodies.size(); ++b) {
    if (m.scene->bodies[b].immovable()) continue;
    StateSeed seed;
    seed.body = static_cast<int>(b), seed.at = Instant::at(time);
    seed.position = {1, 0.7, -0.4}, seed.orientation = {0.3, 1, 0.2}, seed.velocity = {-0.5, 1, 0.3}, seed.angular_velocity = {0.1, -0.2, 0.05};
    seeds.push_back(seed);
  }
  return seeds;
}

void expectSame(const Vec3& found, const Vec3& expected, double tolerance, const std::string& what) {
  const double size = std::max(1.0, expected.cwiseAbs().maxCoeff());
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(std::abs(found[i] - expected[i]) <= tolerance * size) << what << ", " << i << ": " << found[i] << " for " << expected[i];
}

TEST(StillKinematic, IsGroundAsWhatIsFixedIs) {
  int compared = 0;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Motion fixed = playLasting(c.fixed, c.duration), still = playLasting(withKinematic(c.fixed), c.duration);
    ASSERT_EQ(fixed.status, still.status) << still.message;
    ASSERT_EQ(fixed.signature(), still.signature());
    for (std::size_t b = 0; b < c.fixed.bodies.size(); ++b)
      for (const double share : {0.3, 0.7, 1.0}) {
        const double t = share * fixed.end;
        const BodyState x = fixed.stateAt(static_cast<int>(b), t), y = still.stateAt(static_cast<int>(b), t);
        const std::string what = c.fixed.bodies[b].name + " at " + std::to_string(t) + " s";
        expectSame(y.position, x.position, kState, "position of " + what);
        expectSame(y.velocity, x.velocity, kState, "velocity of " + what);
        expectSame(y.angular_velocity, x.angular_velocity, kState, "spin of " + what);
      }
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

TEST(StillKinematic, HasTheDerivativesOfWhatIsFixed) {
  int marked = 0;
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Motion fixed = playLasting(c.fixed, c.duration), still = playLasting(withKinematic(c.fixed), c.duration);
    if (fixed.status != MotionStatus::complete || fixed.signature() != still.signature()) continue;
    Reliability of_fixed, of_still;
    const SceneGradient g = adjoint(fixed, seedsOf(fixed, fixed.end), &of_fixed), h = adjoint(still, seedsOf(still, still.end), &of_still);
    EXPECT_EQ(of_fixed.reliable, of_still.reliable) << of_still.message;
    for (std::size_t b = 0; b < c.fixed.bodies.size(); ++b) {
      const std::string& name = c.fixed.bodies[b].name;
      expectSame(h.bodies[b].position, g.bodies[b].position, kDerivative, name + ", position");
      expectSame(h.bodies[b].orientation, g.bodies[b].orientation, kDerivative, name + ", orientation");
      if (c.fixed.bodies[b].immovable()) continue;
      expectSame(h.bodies[b].velocity, g.bodies[b].velocity, kDerivative, name + ", velocity");
      expectSame(h.bodies[b].angular_velocity, g.bodies[b].angular_velocity, kDerivative, name + ", spin");
    }
    for (std::size_t b = 0; b < c.fixed.bodies.size(); ++b) {
      if (!still.scene->bodies[b].kinematic) continue;
      Reliability asked = of_still;
      asked.askVelocity(static_cast<int>(b));
      marked += !asked.reliable && asked.message.find("a kinematic body at rest") != std::string::npos;
    }
  }
  EXPECT_GE(marked, 5);
}

// A lift that begins to move carries what lies on it; a replay along the motion at rest is refused.
TEST(StillKinematic, IsNoGroundOnceItMoves) {
  Scene scene = withKinematic(cases().back().fixed);
  const Motion at_rest = playLasting(scene, 2);
  ASSERT_EQ(at_rest.status, MotionStatus::complete) << at_rest.message;
  scene.bodies[1].velocity = {0, 0, 0.01};
  const Motion carried = playLasting(scene, 2);
  ASSERT_EQ(carried.status, MotionStatus::complete) << carried.message;
  EXPECT_EQ(carried.world_lines[0].arcs.back().kind(), ArcKind::ride);
  EXPECT_NEAR(carried.stateAt(0, 2).position.z() - at_rest.stateAt(0, 2).position.z(), 0.02, 1e-12);
  const MotionAlong along = simulateAlong(at_rest, scene, at_rest.geometry, 2);
  EXPECT_FALSE(along.complete);
  EXPECT_NE(along.why_not.find("moves"), std::string::npos) << along.why_not;
}

}  // namespace
}  // namespace carom::still_kinematic
