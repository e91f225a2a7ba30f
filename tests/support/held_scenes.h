// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tests/support/scenes.h"

namespace carom::test {

/// A body that contacts hold on corners, edges or faces.
struct HeldCase {
  const char* name;
  Scene scene;
  double duration;
};
std::vector<HeldCase> heldScenes();

}  // namespace carom::test
