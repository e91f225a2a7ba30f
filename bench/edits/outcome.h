// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "bench/edits/configurations.h"
#include "bench/edits/tasks.h"

namespace carom::bench {

/// Of every row, dimensionless, after fresh simulation.
inline constexpr double kLargestResidual = 1e-8;

/// What one configuration made of one task. Residual, objective and bounds are computed here from the numbers of the
/// answer, put into the scene as written and simulated afresh: nothing of the solver's own account is used.
struct Outcome {
  bool met = false;      ///< residual and bounds; whatever the status says
  bool claimed = false;  ///< the status says solved
  EditStatus status = EditStatus::not_converged;
  std::string message;
  double residual = 0, objective = 0;
  int iterations = 0;
  double milliseconds = 0;      ///< of Edit::solve, from outside
  double cpu_milliseconds = 0;  ///< of the whole process in that time: right where one task is solved at a time
  bool sequence_changed = false;
};

Outcome solve(const Task& task, const Configuration& configuration, double budget_seconds);

/// What values of the numbers that vary come to: fills in `met`, `residual` and `objective`.
void judge(const Task& task, ContactSource& contacts, const Eigen::VectorXd& values, Outcome& outcome);

}  // namespace carom::bench
