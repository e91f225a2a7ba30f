// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/solve/edit_evaluator.hpp"
#include "editing/strategy/local_solve_score.hpp"

/// The local solve: from a sample onto the constraints, then along them to the smallest change. Internal to editing/.
namespace carom::editing_detail {

/// The smallest changes that meet the rows as they are linear around a differentiated point, within the bounds; free
/// times stay near those of the point. Where the rows are linear indeed, it is where the edit ends.
Eigen::VectorXd smallestChange(const EditEvaluator& evaluator, const EditPoint& point);
/// The length of the changes of controls alone.
double lengthOf(const EditProblem& problem, const Eigen::VectorXd& changes);

/// Of a differentiated point; `onto` is the step onto the constraints from there (smallestStep).
LocalSolveEstimate estimateOf(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& onto);

/// How a local solve is made, and when it ends.
struct LocalSolveOptions {
  int max_steps = 30;
  /// Given up where no smaller change than this is in sight: the edit knows one of this length. Steps are looked for
  /// less hard then.
  double below = std::numeric_limits<double>::infinity();
  const std::string* signature = nullptr;  ///< not null: points of other impact sequences are refused
  double arrived = 1e-3;  ///< the way along the constraints that is left, as a share of the change, at which it ends
};

/// Steps onto the constraints and along them towards the smallest change, whatever impacts that takes. Each is
/// accepted where it makes the merit |z|^2 / 2 + nu |r|_1 smaller, nu above the multipliers of the linear rows. The
/// point with the smallest violation, of those within the tolerance that with the smallest change; null where it was
/// given up.
EditPointPtr solveLocally(EditEvaluator& evaluator, const EditPointPtr& from, const LocalSolveOptions& options);
/// The same, where a smaller change than a known one is looked for. If the constraints are missed, the fallbacks are a projection
/// onto them alone, within the impact sequence of `from` and else across its boundaries, and from there along them.
EditPointPtr solveWithFallbacks(EditEvaluator& evaluator, const EditPointPtr& from, const LocalSolveOptions& options);

}  // namespace carom::editing_detail
