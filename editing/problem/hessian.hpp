// SPDX-License-Identifier: MIT
#pragma once

#include "editing/problem/jacobian.hpp"

/// Second derivatives of an edit. Internal to editing/.
namespace carom::editing_detail {

/// Second derivatives of weights . (values of the rows, SI), and of an objective of one's own with its weight, by the unknowns of a problem, whose motion and rows were
/// read at `unknowns`: exact, by differentiating the adjoint pass (adjoint/second_order/second_order.h). Rows without weight may be
/// missing, or have no second derivatives (RowNote::second_order); one with weight throws NotComputable then.
Eigen::MatrixXd rowsHessian(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                            const RowValues& rows, const Eigen::VectorXd& weights, double objective_weight = 0);

/// The same of weights . (rows of validity).
Eigen::MatrixXd validityHessian(const EditProblem& problem, const Eigen::VectorXd& unknowns,
                                const Eigen::VectorXd& weights);

}  // namespace carom::editing_detail
