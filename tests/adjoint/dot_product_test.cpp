// SPDX-License-Identifier: MIT
// Equation 5.5: the tangent and the adjoint pass are each other's transpose, <J u, w> = <u, J^T w>, for every control,
// impact law, flight tier and pair of features. Errors are relative to the sums of absolute products.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/dot_product_scenes.h"
#include "tests/support/transposed.h"

namespace carom {
namespace {

using namespace test;

class DotProduct : public ::testing::TestWithParam<DotProductScene> {};

TEST_P(DotProduct, TangentAndAdjointAreTransposed) {
  const DotProductScene& row = GetParam();
  const Motion m = motionOf(row);
  ASSERT_FALSE(m.events.empty());
  for (const char* word : row.has)  // the row is about what its name says
    EXPECT_NE(
        (m.describeEvent(0) + " " + nameOf(m.plan.bodies[0].tier) + "/" + nameOf(m.plan.bodies[0].derivative_tier))
            .find(word),
        std::string::npos)
        << word << " in " << m.describeEvent(0);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectTransposed(m, seed);
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, DotProduct, ::testing::ValuesIn(dotProductScenes()),
                         [](const auto& row) { return std::string(row.param.name); });

// Controls that a motion does not depend on have no derivative, in either pass; those that it does depend on have one.
TEST(DotProductRows, EveryControlMattersInSomeRow) {
  for (const ControlRow& control : controlRows()) {
    bool matters = false;
    for (const DotProductScene& row : dotProductScenes()) {
      const Scene scene = row.scene();
      const Motion m = play(scene, 3, row.impacts);
      Random random(5);
      const SceneTangent all = randomDirection(scene, random);
      SceneTangent d(scene);
      control.copy(d, all);
      const StateSeed seed = randomSeed(movingBodies(scene)[0], Instant::at(m.end), random);
      matters |= std::abs(adjoint(m, std::span(&seed, 1)).dot(d)) > 1e-3;
    }
    EXPECT_TRUE(matters) << control.name;
  }
}

}  // namespace
}  // namespace carom
