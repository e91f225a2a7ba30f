// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "editing/jacobian.h"

/// Where a motion is cut for multiple shooting. Internal to editing/.
namespace carom {

/// A place between two impacts, in the middle of flights.
struct Node {
  double time = 0;                        ///< s, of the motion that is cut
  int before = -1, after = -1;            ///< events of that motion on both sides of it
  int body_before = -1, body_after = -1;  ///< that take part in them, and matter
  std::vector<int> bodies;                ///< whose states at the node matter to the constraints
};

struct Cut {
  std::vector<int> bodies;  ///< moving ones that matter from the start on
  std::vector<Node> nodes;  ///< in increasing order of time
};

/// Cuts a motion after every so many impacts of bodies that matter: those of the constraints, and backwards in time
/// everything that touches what matters later on. A flight in which a constraint is read is not cut, nor one that is
/// much shorter than the natural time of its bodies. No nodes where there is nothing to cut.
Cut cutMotion(const EditProblem& problem, const Motion& motion, const Eigen::VectorXd& free_times,
              int impacts_per_segment);

/// Events of a motion that the constraints depend on: those that bodies that matter take part in.
int impactsThatMatter(const EditProblem& problem, const Motion& motion, const Eigen::VectorXd& free_times);

}  // namespace carom
