// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "editing/problem/edit_problem.hpp"

/// The rows of an edit and their derivatives. Internal to editing/.
namespace carom::editing_detail {

/// All rows of a problem at one point, and their exact derivative with respect to every control value (SI by SI).
struct RowsAndJacobian {
  Motion motion;
  RowValues rows;
  Eigen::MatrixXd jacobian;              ///< rows x controls; rows that are not available are NaN
  std::vector<Reliability> reliability;  ///< of each row; by adjoint only
};

/// Tells the reliability of a row which coefficients of friction and which spins vary.
void askControls(const ControlSet& controls, Reliability& reliability);

/// Adds what a row says of its own derivative (RowNote::doubt); nothing where that is empty.
void doubt(const std::string& why, Reliability& reliability);

/// d(rows)/d(values) of a motion simulated at `values`: one reverse pass a row, whatever the number of controls.
Eigen::MatrixXd jacobianByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows, std::vector<Reliability>* reliability = nullptr);
/// The same by one forward pass a control.
Eigen::MatrixXd jacobianByTangent(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows);

/// d(w r)/d(unknowns) of the soft constraints' rows, w r as in SoftTerms: by the passes that are fewer. Throws NotComputable.
Eigen::MatrixXd softJacobian(const EditProblem& problem, const Eigen::VectorXd& unknowns, const Motion& motion,
                             const RowValues& soft_rows);

/// d(rows)/d(free times): size() x times(), SI.
Eigen::MatrixXd jacobianByTimes(const EditProblem& problem, const Motion& motion, const RowValues& rows);

RowsAndJacobian evaluateByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values);
RowsAndJacobian evaluateByTangent(const EditProblem& problem, const Eigen::VectorXd& values);

}  // namespace carom::editing_detail
