// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <stop_token>

#include "adjoint/base/times.h"

namespace carom {

/// Whether an edit may change the impact sequence.
enum class SequencePolicy {
  smallest,      ///< if that makes the change smaller
  prefer_start,  ///< only if the constraints cannot be met within the initial sequence
  stay,          ///< never
};

/// Work limit of the search for a smaller change once the constraints are met, and for a solution if there is none
/// nearby. Work is counted, so the result is the same on every machine and for any number of threads
/// (docs/editing.md).
enum class Effort {
  fast,     ///< the first solution
  normal,   ///< a few more rounds of samples
  thorough  ///< many more rounds
};

/// Progress of an edit.
struct EditProgress {
  int iteration = 0;     ///< steps so far
  double objective = 0;  ///< 1/2 sum (w_i z_i)^2
  double violation = 0;  ///< dimensionless
};

/// Second derivatives of the rows in Ipopt.
enum class SecondDerivatives {
  exact,          ///< adjoint/second_order/second_order.h
  secant,         ///< secant (quasi-Newton) updates row by row: cheaper iterations, more of them
  limited_memory  ///< Ipopt's limited-memory approximation
};

/// Edit::solve was stopped, with EditOptions::abandon: there is no answer.
class EditAbandoned : public std::runtime_error {
 public:
  EditAbandoned() : std::runtime_error("the edit was abandoned") {}
};

/// Options of an edit.
struct EditOptions {
  int max_iterations = 10000;  ///< of all stages together; the last stage may exceed it by a few
  Seconds time_budget_seconds = std::numeric_limits<double>::infinity();  ///< s
  double tolerance = 1e-9;  ///< of every row, dimensionless (docs/equations.md section 6)
  SequencePolicy sequence = SequencePolicy::smallest;                   ///< whether the impact sequence may change
  Effort effort = Effort::normal;                                   ///< work limit of the search
  SecondDerivatives second_derivatives = SecondDerivatives::exact;  ///< used by Ipopt
  /// How far inside an answer goes where a needed impact would be lost at a smaller change, natural scales times weights; less
  /// of it where it makes the objective larger by more than 1 %. 0: the smallest change itself, which may just graze.
  double graze_margin = 1e-3;
  int alternatives = 1;  ///< number of distinct solutions to search for, see EditResult::alternatives
  /// 0 to 1000: seed of the sample sequence. The search is not exhaustive; another seed may find a smaller change.
  int seed = 0;
  int threads = 0;       ///< of the search across impact sequences; 0: all cores. Does not affect the result
  bool certify = true;   ///< fill in EditResult::certificate
  /// Of each motion, see SimulateOptions::step_limit: a point whose motion ends before its constraints is rejected.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  /// Once a stop is requested, from any thread, the edit ends with EditStatus::cancelled and its best point,
  /// simulated again: EditResult::met tells whether it meets the constraints.
  std::stop_token stop;
  /// Once stopped, Edit::solve throws EditAbandoned as soon as it can: sooner than an answer could be completed.
  bool abandon = false;
  bool explain = true;   ///< fill in EditResult::why_not if the edit is infeasible or does not converge
  std::function<bool(const EditProgress&)> progress;  ///< returning false cancels; must not solve another edit
};

}  // namespace carom
