// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tests/support/scenes.h"

namespace carom::test {

/// A body that contacts hold on corners, edges or faces.
struct ConstrainedCase {
  const char* name;
  Scene scene;
  double duration;
  double smooth = 0;  ///< s, from which on derivatives are not those of all changes; 0: they are to the end
};
std::vector<ConstrainedCase> constrainedScenes();

}  // namespace carom::test
