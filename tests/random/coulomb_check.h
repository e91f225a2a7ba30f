// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "adjoint/motion/motion.h"

namespace carom::test {

/// What was seen of one convex body that moves among fixed planes, from its states alone.
struct CoulombFindings {
  double worst_depth = 0;   ///< m, below a plane
  double worst_growth = 0;  ///< of energy, as a share of what the body has had
  double worst_force = 0;   ///< what Coulomb's law at the points in touch leaves of the rate of momentum, as a share of it
  double worst_impulse = 0; ///< the same of its jumps
  int looks = 0;            ///< at rates of momentum
  std::string first;        ///< sentence on the first that is beyond what is allowed; empty: none
};

/// Body 0 of the motion against all others, which are planes. Geometry, forces and impulses share nothing with the product:
/// points in touch are those of the shape nearest to each plane, rates of momentum differences of states at four times, and
/// forces the non-negative least squares over the directions that Coulomb's law allows where the point slides or not.
CoulombFindings checkAmongPlanes(const Motion& motion);

}  // namespace carom::test
