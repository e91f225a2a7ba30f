// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/control.h"

namespace carom {

/// A control parameter with its value in the scene.
struct SessionNumber {
  std::string name;       ///< "velocity.x of 'hat'"
  double value = 0;       ///< SI
  int control = -1;       ///< index of its Control
  std::string component;  ///< "x", "radius", "value"; of an orientation "w", "x", "y" or "z"
  bool varies = false;    ///< false: listed to complete its vector
  double min = -std::numeric_limits<double>::infinity();  ///< lower bound, SI
  double max = std::numeric_limits<double>::infinity();   ///< upper bound, SI
  double scale = 1;                                       ///< natural scale of a change, SI
};
/// All control parameters of a scene, and the other components of the same vectors; an orientation as w, x, y, z,
/// without bounds. Throws InputError naming "/controls/<i>" for controls that are invalid for the scene.
std::vector<SessionNumber> sessionNumbers(const Scene& scene, const std::vector<Control>& controls);

}  // namespace carom
