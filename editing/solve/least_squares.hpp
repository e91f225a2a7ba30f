// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "editing/solve/edit_evaluator.hpp"

/// Least squares of soft constraints. Internal to editing/.
namespace carom::editing_detail {

/// The objective 1/2 |W r|^2 + 1/2 |z|^2 around a point, and what is held there, as they are linear in the unknowns.
struct LeastSquaresModel {
  Eigen::VectorXd r;  ///< W r
  Eigen::MatrixXd S;  ///< d(W r)/d(unknowns)
  Eigen::MatrixXd J;  ///< of the rows that are held: equations, ranges that are left or at a limit, validity that lacks
  Eigen::VectorXd h;  ///< their residuals
};
/// Of a point that has all rows; throws NotComputable. `held_ranges`: of the rows that are ranges, those to hold beside. With
/// `until` errors that are read later, or at an event, are left out (0), s.
LeastSquaresModel leastSquaresModel(const EditProblem& problem, EditPoint& point, const std::vector<int>& held_ranges,
                                    double until = std::numeric_limits<double>::infinity());
/// Up to when an error reads the motion, s; nothing where an event, or the whole motion, decides.
std::optional<double> recordedUntil(const Row& row, const When& at);
/// The objective of the errors up to `until`.
double objectiveUntil(double until, const EditProblem& problem, const EditPoint& point);

/// Levenberg-Marquardt steps, each tried by simulation whatever its impacts, from a point that meets the hard constraints;
/// each is brought back onto them. The last point, with the smallest objective. Ends where the steps do, and after
/// `max_steps`. With `until` only the errors of places up to that time count, s: then the last point is that of the smallest
/// sum of these.
EditPointPtr minimiseLeastSquares(EditEvaluator& evaluator, EditPointPtr point, int max_steps,
                                  double until = std::numeric_limits<double>::infinity());

}  // namespace carom::editing_detail
