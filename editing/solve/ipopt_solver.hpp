// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/solve/nonlinear_program.hpp"

namespace carom::editing_detail {

enum class SolverStatus {
  converged,
  acceptable,  ///< converged to a looser tolerance
  infeasible,  ///< at a point where the violation cannot be made smaller nearby
  iteration_limit,
  stopped,            ///< NonlinearProgram::iteration() returned false
  cannot_evaluate,    ///< the start, or everything near a point, was refused
  too_few_variables,  ///< more equations than variables
  no_progress,        ///< steps became too small, or the problem is unbounded or singular
  failed,             ///< anything else that went wrong inside the solver
};

struct SolverOptions {
  int max_iterations = 200;
  double tolerance = 1e-8;  ///< of the optimality conditions
  double constraint_tolerance = 1e-9;
  /// How far from its bounds the start is moved, and the first weight of the barrier that keeps it there.
  double bound_push = 1e-4;
  double barrier = 1e-4;
};

struct SolverResult {
  SolverStatus status = SolverStatus::failed;
  std::string message;  ///< one sentence
  Eigen::VectorXd x;    ///< the last point
  Eigen::VectorXd multipliers;
  double objective = 0;
  int iterations = 0;
};

/// Solves a program with Ipopt (Wächter and Biegler, Mathematical Programming 106(1), 2006). Ipopt and its linear
/// solver are not safe in two threads, so that all calls of the process share one lock: a program must not call this
/// function from its own functions. An exception out of NonlinearProgram::iteration() stops the solver and is thrown
/// on; one out of an evaluation counts as a refused point.
SolverResult solveWithIpopt(NonlinearProgram& program, const SolverOptions& options = {});

}  // namespace carom::editing_detail
