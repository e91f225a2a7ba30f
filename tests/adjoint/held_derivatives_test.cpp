// SPDX-License-Identifier: MIT
// Derivatives of bodies that contacts hold on corners, edges and faces.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/compare.h"
#include "tests/support/held_scenes.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/offset_scenes.h"
#include "tests/support/transposed.h"

namespace carom::held_derivatives {
namespace {

using namespace test;

class HeldDerivatives : public ::testing::TestWithParam<HeldCase> {};

TEST_P(HeldDerivatives, TangentAndAdjointAreTransposed) {
  Scene scene = GetParam().scene;
  for (bool reverse : {false, true}) {
    if (reverse) std::reverse(scene.bodies.begin(), scene.bodies.end());
    const Motion m = playLasting(scene, GetParam().duration);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE((reverse ? "reversed, seed " : "seed ") + std::to_string(seed));
      expectTransposed(m, seed);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, HeldDerivatives, ::testing::ValuesIn(heldScenes()), [](const auto& info) {
  std::string name = info.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
});

}  // namespace
}  // namespace carom::held_derivatives
