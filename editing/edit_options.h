// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <stop_token>

namespace carom {

/// May an edit change which impacts happen?
enum class SequencePolicy {
  prefer_start,  ///< only where the start's sequence does not reach the constraints
  stay,          ///< never
};

struct EditProgress {
  int iteration = 0;
  double objective = 0;
  double violation = 0;  ///< dimensionless
};

/// Where Ipopt takes the second derivatives of the rows from.
enum class SecondDerivatives {
  exact,          ///< adjoint/second_order/second_order.h
  secant,         ///< learnt from the gradients, row by row: cheaper steps, more of them (docs/decisions.md)
  limited_memory  ///< Ipopt's own approximation
};

struct EditOptions {
  int max_iterations = 200;  ///< steps of all stages together; the one under way may add a few
  double time_budget_seconds = std::numeric_limits<double>::infinity();
  double tolerance = 1e-9;  ///< of every row, dimensionless (docs/equations.md section 6)
  SequencePolicy sequence = SequencePolicy::prefer_start;
  SecondDerivatives second_derivatives = SecondDerivatives::exact;
  int alternatives = 1;  ///< distinct solutions that are looked for, see EditResult::alternatives
  int threads = 0;       ///< of the search across impact sequences; 0: all cores. The answer does not depend on it
  bool certify = true;   ///< fill in EditResult::certificate
  /// Of each motion, see SimulateOptions::step_limit: a point whose motion ends before its constraints is not taken.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  /// Once a stop is requested, from any thread, the edit ends with EditStatus::cancelled and the best that it has.
  std::stop_token stop;
  bool explain = true;   ///< fill in EditResult::why_not where the edit is infeasible or does not converge
  std::function<bool(const EditProgress&)> progress;  ///< false cancels; must not solve an edit itself
};

}  // namespace carom
