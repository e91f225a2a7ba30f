// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/solve/edit_evaluator.hpp"

/// Straight onto the constraints, without minimising the change. Internal to editing/.
namespace carom::editing_detail {

/// Steps onto the constraints from a point near them, at most: before the change is minimised, and after it.
inline constexpr int kOntoSteps = 15;
/// Steps of a free time count so much less than those of a control.
inline constexpr double kTimeIsCheap = 100;

/// How hard a step with a smaller violation is looked for, from each point on the way.
enum class Care {
  full,
  coarse  ///< fewer lengths and dampings: for a point that is one of many
};

/// Gauss-Newton steps onto the constraints, each the smallest change that meets the linearised rows within the bounds;
/// damped (Levenberg and Marquardt) where no way along such a step makes the violation smaller. Quadratic near a
/// solution. With a signature, points of another impact sequence are refused. Returns the point with the smallest
/// violation that was met.
EditPointPtr projectOntoConstraints(EditEvaluator& evaluator, EditPointPtr from, int max_steps,
                                    const std::string* signature = nullptr, Care care = Care::full);

/// The step that projectOntoConstraints would take from a differentiated point.
Eigen::VectorXd smallestStep(const EditEvaluator& evaluator, const EditPoint& point, double damping = 0);

/// Scaled residuals of all rows after a step, to first order.
Eigen::VectorXd residualsAfter(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& step);

}  // namespace carom::editing_detail
