// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// One step of a drag from first derivatives. Internal to editing/.
namespace carom::editing_detail {

/// Rows r + J d of a step d.
struct LinearRows {
  Eigen::MatrixXd J;
  Eigen::VectorXd r;

  void add(const Eigen::RowVectorXd& row, double residual);
  Eigen::Index size() const { return r.size(); }
};

/// What a step is to do, in order: hard rows come to 0 and `within` rows stay >= 0, within bounds; then soft rows come
/// as near to 0 as they can (least squares); what freedom is left makes |at + d|^2 + |terms|^2 smaller.
struct StepProblem {
  Eigen::VectorXd at, lower, upper;
  Eigen::Index costless = 0;  ///< so many unknowns at the end are not drawn towards 0
  LinearRows hard, within, soft;
  LinearRows terms;  ///< of soft constraints, W r; may be empty
  double longest = 1;  ///< longest part of a step for one purpose
  double ease = 1;   ///< share of the way towards 0 that is taken
};

struct Step {
  Eigen::VectorXd d;
  Eigen::VectorXd towards_zero;  ///< the whole of what would make the objective smallest, of which `ease` is taken
  double soft_after = 0;         ///< |soft rows| after it, to first order
  bool free_for_soft = true;     ///< false: hard rows and bounds leave nothing that moves the soft rows
};

Step hierarchicalStep(const StepProblem& problem);

}  // namespace carom::editing_detail
