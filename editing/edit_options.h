// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <stop_token>

namespace carom {

/// May an edit change which impacts happen?
enum class SequencePolicy {
  smallest,      ///< wherever the change is smaller
  prefer_start,  ///< only where the start's sequence does not reach the constraints
  stay,          ///< never
};

/// How long an edit looks for a smaller change once its constraints are met, and for a way to meet them where none is
/// near. The work is counted, so that the answer is the same on every machine and any number of threads
/// (docs/editing.md).
enum class Effort {
  fast,     ///< the first solution
  normal,   ///< a few rounds of samples more
  thorough  ///< many
};

/// How far an edit is.
struct EditProgress {
  int iteration = 0;     ///< steps so far
  double objective = 0;  ///< 1/2 sum (w_i z_i)^2
  double violation = 0;  ///< dimensionless
};

/// Where Ipopt takes the second derivatives of the rows from.
enum class SecondDerivatives {
  exact,          ///< adjoint/second_order/second_order.h
  secant,         ///< learnt from the gradients, row by row: cheaper steps, more of them (docs/decisions.md)
  limited_memory  ///< Ipopt's own approximation
};

/// How an edit is solved.
struct EditOptions {
  int max_iterations = 10000;  ///< steps of all stages together; the one under way may add a few
  double time_budget_seconds = std::numeric_limits<double>::infinity();  ///< gives up after so long
  double tolerance = 1e-9;  ///< of every row, dimensionless (docs/equations.md section 6)
  SequencePolicy sequence = SequencePolicy::smallest;                   ///< whether impacts may become others
  Effort effort = Effort::normal;                                   ///< how long a smaller change is looked for
  SecondDerivatives second_derivatives = SecondDerivatives::exact;  ///< where Ipopt takes them from
  int alternatives = 1;  ///< distinct solutions that are looked for, see EditResult::alternatives
  /// 0 to 1000: where the samples of the search begin. Where a change is larger than it could be is largely chance: another
  /// seed is another try.
  int seed = 0;
  int threads = 0;       ///< of the search across impact sequences; 0: all cores. The answer does not depend on it
  bool certify = true;   ///< fill in EditResult::certificate
  /// Of each motion, see SimulateOptions::step_limit: a point whose motion ends before its constraints is not taken.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  /// Once a stop is requested, from any thread, the edit ends with EditStatus::cancelled and the best that it has,
  /// simulated afresh: EditResult::met says whether it meets the constraints.
  std::stop_token stop;
  bool explain = true;   ///< fill in EditResult::why_not where the edit is infeasible or does not converge
  std::function<bool(const EditProgress&)> progress;  ///< false cancels; must not solve an edit itself
};

}  // namespace carom
