// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "tests/random/ground_touch.h"

namespace carom::test {

/// What was seen of one convex body that moves among fixed ones, from its states alone.
struct CoulombFindings {
  double worst_depth = 0;   ///< m, in a ground
  double worst_growth = 0;  ///< of energy, as a share of what the body has had
  double worst_force = 0;   ///< what Coulomb's law at the points in touch leaves of the rate of momentum, as a share of it
  double worst_impulse = 0; ///< the same of its jumps
  int looks = 0;            ///< at rates of momentum
  std::string first;        ///< sentence on the first that is beyond what is allowed; empty: none

  void add(const CoulombFindings& other);  ///< the worst of both, and the looks of both
};

/// Body 0 of the motion against these grounds, which all others make up. Geometry, forces and impulses share nothing with the
/// product: points in touch are those of the shape nearest to each ground, rates of momentum differences of states at four
/// times, and forces the non-negative least squares over the directions that Coulomb's law allows where the point slides or not.
CoulombFindings checkOnGrounds(const Motion& motion, const std::vector<Ground>& grounds);
/// The same where all others are planes.
CoulombFindings checkAmongPlanes(const Motion& motion);

}  // namespace carom::test
