// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/jacobian.h"

namespace carom {

/// Besides place and velocity, what of the state of a body its later motion and the constraints depend on. Internal to
/// editing/.
struct StateParts {
  bool orientation = true, spin = true;
  int size() const { return 6 + 3 * (orientation + spin); }
};

/// Of every body of a motion of the problem.
std::vector<StateParts> stateParts(const EditProblem& problem, const Motion& motion);

}  // namespace carom
