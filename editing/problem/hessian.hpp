// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/second_order/second_order.h"
#include "editing/problem/edit_problem.hpp"

/// Second derivatives of an edit. Internal to editing/.
namespace carom::editing_detail {

/// Second derivatives, with respect to the unknowns of a problem whose motion and rows were read at `unknowns`, of
/// weights . (values of the rows, SI), and of an objective of one's own with its weight: exact, by differentiating the adjoint pass (adjoint/second_order/second_order.h). Rows without weight may be
/// missing, or have no second derivatives (RowNote::second_order); one with weight throws NotComputable then.
Eigen::MatrixXd rowsHessian(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                            const RowValues& rows, const Eigen::VectorXd& weights, double objective_weight = 0);

/// Second derivatives of the same sum, by control values and free times in SI, along directions.
struct RowsCurvature {
  Eigen::MatrixXd along;     ///< H D, with the directions D as columns
  Eigen::VectorXd gradient;  ///< of the sum, by the control values
};
/// `wanted`: RatesWanted::varied only if the directions vary all controls together.
RowsCurvature rowsCurvature(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                            const RowValues& rows, const Eigen::VectorXd& weights, double objective_weight,
                            const Eigen::MatrixXd& directions, RatesWanted wanted);

/// Second derivatives by the unknowns of weights . (rows of validity).
Eigen::MatrixXd validityHessian(const EditProblem& problem, const Eigen::VectorXd& unknowns,
                                const Eigen::VectorXd& weights);

}  // namespace carom::editing_detail
