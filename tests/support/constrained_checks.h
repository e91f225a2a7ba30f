// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"

namespace carom::test {

/// What was seen of the bodies of a motion that contacts hold.
struct ConstrainedFindings {
  int paths = 0, steps = 0;   ///< that are integrated
  double worst_gap = 0;       ///< m, of a contact that holds
  double worst_growth = 0;    ///< J/kg, above the least energy that a body had before, on its arcs and over their ends
};
/// Looks `samples` times at each step of an integrated path, and as often at every other arc. Energy is looked at of the
/// bodies that meet fixed ones alone.
ConstrainedFindings lookAtConstrainedPaths(const Motion& motion, int samples);

/// Kinetic energy and that of height of one body over its mass, J/kg.
double energyPerMass(const Motion& motion, int body, const State& state);

}  // namespace carom::test
