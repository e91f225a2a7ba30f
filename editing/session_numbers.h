// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/control.h"

namespace carom {

/// A number that may vary, as the scene has it.
struct SessionNumber {
  std::string name;       ///< "velocity of 'hat', x"
  double value = 0;       ///< SI
  int control = -1;       ///< index of its Control
  std::string component;  ///< "x", "radius", "value"; of an orientation "w", "x", "y" or "z"
  bool varies = false;    ///< false: it is there for the others of its vector
  double min = -std::numeric_limits<double>::infinity();  ///< least value that it may take, SI
  double max = std::numeric_limits<double>::infinity();   ///< greatest value that it may take, SI
  double scale = 1;                                       ///< what counts as much for a change of it, SI
};
/// All numbers of a scene that the controls vary, and the others of the same vectors; an orientation as w, x, y, z,
/// without bounds. Throws InputError naming "/controls/<i>" for controls that make no sense in the scene.
std::vector<SessionNumber> sessionNumbers(const Scene& scene, const std::vector<Control>& controls);

}  // namespace carom
