// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// What can be reached from a point to first order. Internal to editing/.
namespace carom::editing_detail {

/// No number is followed further than this from the point, in natural scales.
inline constexpr double kLargestStep = 10;

/// The rows of a point as linear functions of a step, within bounds. All dimensionless.
struct LinearModel {
  Eigen::MatrixXd J;             ///< rows x unknowns
  Eigen::VectorXd value;         ///< of the rows at the point
  Eigen::VectorXd low, high;     ///< allowed values of the rows
  Eigen::VectorXd lower, upper;  ///< of the step

  LinearModel(const EditEvaluator& evaluator, EditPoint& point);

  /// The step that brings some rows nearest to what is allowed, and how far off they stay (Euclidean).
  struct Nearest {
    Eigen::VectorXd step;
    double off = 0;
  };
  Nearest nearest(const std::vector<int>& rows) const;
  std::vector<int> allRows() const;

  /// Adds columns, with bounds on their steps.
  void extend(const Eigen::MatrixXd& columns, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
};

/// Sets of rows that cannot be met together, each such that leaving out any one row leaves the others reachable (by
/// deletion filtering); disjoint, at most `most`.
std::vector<std::vector<int>> conflictsIn(const LinearModel& linear, double met, std::size_t most);

}  // namespace carom::editing_detail
