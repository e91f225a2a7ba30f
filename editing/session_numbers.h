// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/control.h"

namespace carom {

/// A number that may vary, as the scene has it.
struct SessionNumber {
  std::string name;  ///< "velocity of 'hat', x"
  double value = 0;  ///< SI
};
/// All numbers of a scene that the controls vary, and the others of the same vectors; an orientation as w, x, y, z.
std::vector<SessionNumber> sessionNumbers(const Scene& scene, const std::vector<Control>& controls);

}  // namespace carom
