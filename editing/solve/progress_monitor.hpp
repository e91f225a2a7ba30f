// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "editing/solve/edit_evaluator.hpp"
#include "editing/solve/nonlinear_program.hpp"

namespace carom::editing_detail {

/// Whether a solver still gets on: it is given up when so many iterations (kMark) neither bring the violation below a
/// fraction of what it was nor, once it is small, still make the change smaller. Internal to editing/.
class ProgressMonitor {
 public:
  /// Counts an iteration of the solver as a step of the search; false where it should stop.
  bool allows(EditEvaluator& evaluator, const NonlinearProgram::Iteration& i) {
    if (i.number == 0) return evaluator.halt() == Halt::none;
    if (!evaluator.step(i.objective, i.violation)) return false;
    lowest_violation_ = std::min(lowest_violation_, i.violation);
    if (i.number % kMark != 0) return true;
    const bool falls = lowest_violation_ <= kEnoughProgress * lowest_at_mark_;
    const bool shrinks = std::abs(i.objective - objective_at_mark_) > kSameObjective * i.objective;
    lowest_at_mark_ = lowest_violation_;
    objective_at_mark_ = i.objective;
    return falls || (shrinks && lowest_violation_ <= kNearlyMet);
  }

 private:
  static constexpr int kMark = 8;
  static constexpr double kEnoughProgress = 0.7, kNearlyMet = 1e-5, kSameObjective = 1e-7;

  double lowest_violation_ = std::numeric_limits<double>::infinity();
  double lowest_at_mark_ = std::numeric_limits<double>::infinity();
  double objective_at_mark_ = std::numeric_limits<double>::infinity();
};

}  // namespace carom::editing_detail
