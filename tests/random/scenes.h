// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "adjoint/scene/scene.h"

namespace carom::brute {

struct RandomScene {
  Scene scene;
  double duration = 1;
};

/// A scene of 2 to 8 balls and boxes that will meet: thrown at each other, over a floor, or in a pen. The same seed
/// gives the same scene.
RandomScene randomScene(std::uint64_t seed);

/// One line a body, to full precision: enough to build the scene by hand.
std::string describe(const RandomScene& random);

}  // namespace carom::brute
