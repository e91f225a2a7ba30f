// SPDX-License-Identifier: MIT
// Bodies whose centre of mass or principal axes are not their shape's: what they get for a model, where they are, and
// that both passes agree on their derivatives (against 50 digits in tests/reference).

#include <gtest/gtest.h>

#include "tests/support/compare.h"
#include "tests/support/offset_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/swept_points.h"
#include "tests/support/transposed.h"

namespace carom {
namespace {

using namespace test;

Motion playSwept(const Scene& scene, double duration, const std::vector<Asked>& asked = {}) {
  SweptPointContacts contacts(scene);
  SimulateOptions options;
  options.asked = asked;
  return simulate(scene, contacts, duration, options);
}

class OffsetBody : public ::testing::TestWithParam<OffsetScene> {};

TEST_P(OffsetBody, GetsTheCheapestTiersThatAreExact) {
  const OffsetScene& row = GetParam();
  const Scene scene = row.scene();
  const BodyPlan plan = makePlan(scene).bodies[0];
  EXPECT_EQ(plan.tier, row.tier) << plan.why;
  EXPECT_EQ(plan.derivative_tier, row.derivative_tier) << plan.derivative_why;
  EXPECT_EQ(plan.derivative_products, row.products) << plan.derivative_why;
  const BodyPlan less = makePlan(scene, {{true, false}, {}}).bodies[0];
  EXPECT_EQ(less.derivative_tier, row.tier) << "no derivative by inertia is asked for";
  EXPECT_FALSE(less.derivative_products);
}

// At the start the state is what was written, and the centre of mass moves like a thrown point.
TEST_P(OffsetBody, IsWhereItIsWritten) {
  const Scene scene = GetParam().scene();
  const Body& body = scene.bodies[0];
  const Motion m = playSwept(scene, GetParam().duration);
  const BodyState start = m.stateAt(0, 0);
  expectEntries(start.position, body.position, 1e-15, "position");
  expectEntries(start.orientation.toRotationMatrix(), body.orientation.toRotationMatrix(), 1e-15, "orientation");
  expectEntries(start.velocity, body.velocity, 1e-15, "velocity");
  expectEntries(start.angular_velocity, body.angular_velocity, 1e-13, "angular velocity");
  const double t = m.events.empty() ? m.end : 0.9 * m.events[0].time;
  const BodyState s = m.stateAt(0, t);
  const Vec3 c = centerOfMass(body);
  expectEntries(Vec3(s.position + s.orientation * c),
                Vec3(body.position + body.orientation * c + t * (body.velocity + 0.5 * t * scene.gravity)), 1e-14,
                "path");
}

TEST_P(OffsetBody, TangentAndAdjointAreTransposed) {
  for (bool floor_first : {false, true}) {
    const Scene scene = floor_first ? floorFirst(GetParam().scene()) : GetParam().scene();
    const Motion m = playSwept(scene, GetParam().duration);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE((floor_first ? "floor first, seed " : "seed ") + std::to_string(seed));
      expectTransposed(m, seed);
    }
  }
}

// With the floor as first body the same motion, mirrored in nothing.
TEST_P(OffsetBody, OrderOfBodiesDoesNotMatter) {
  const Scene scene = GetParam().scene(), turned = floorFirst(scene);
  const double T = GetParam().duration;
  const Motion m = playSwept(scene, T), n = playSwept(turned, T);
  ASSERT_EQ(m.events.size(), n.events.size());
  EXPECT_EQ(flatten(m.stateAt(0, T)), flatten(n.stateAt(1, T)));
  for (int i = 0; i < 12; ++i) {
    const SceneGradient g = gradientOf(m, 0, T, i), h = gradientOf(n, 1, T, i);
    SceneGradient swapped(scene);
    swapped.gravity = h.gravity, swapped.materials = h.materials;
    swapped.bodies = {h.bodies[1], h.bodies[0]};
    const double size = flatten(g).cwiseAbs().maxCoeff();
    expectEntries(flatten(swapped), flatten(g), 1e-13, "gradient of number " + std::to_string(i), size);
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, OffsetBody, ::testing::ValuesIn(offsetScenes()),
                         [](const auto& row) { return std::string(row.param.name); });

// A centre of mass that is written where the shape has its own changes nothing; only sizes, which no longer move it,
// do.
TEST(OffsetBody, WritingTheCentreThatItHas) {
  for (const OffsetScene& row : offsetScenes()) {
    SCOPED_TRACE(row.name);
    const Scene scene = row.scene();
    if (scene.bodies[0].center_of_mass) continue;
    Scene written = scene;
    written.bodies[0].center_of_mass = centerOfMass(scene.bodies[0]);
    const Motion m = playSwept(scene, row.duration), n = playSwept(written, row.duration);
    EXPECT_EQ(flatten(m.stateAt(0, row.duration)), flatten(n.stateAt(0, row.duration)));
    EXPECT_TRUE(centerOfMassRates(written.bodies[0]).isZero(0));
  }
}

}  // namespace
}  // namespace carom
