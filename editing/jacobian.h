#pragma once

#include <vector>

#include <Eigen/Core>

#include "adjoint/simulate.h"
#include "editing/constraint_rows.h"
#include "editing/control_set.h"
#include "editing/validity_rows.h"

namespace carom {

/// Controls and constraints bound to a scene: what is varied, what is held, and what has to be simulated for it.
struct EditProblem {
  /// Throws InputError for a scene, controls or constraints that make no sense. `contacts` is kept by reference.
  EditProblem(const Scene& scene, ContactSource& contacts, double duration, const std::vector<Control>& controls,
              const std::vector<Constraint>& constraints);

  ContactSource* contacts;
  ControlSet controls;
  ConstraintSet constraints;
  ValidityRows validity;
  double duration;           ///< s, of the motion
  double horizon;            ///< s; nothing after it counts for the constraints
  std::vector<Asked> asked;  ///< as little as the rows and their derivatives need
};

/// All rows of a problem at one point, and their exact derivative by every control value (SI by SI).
struct RowsAndJacobian {
  Motion motion;
  RowValues rows;
  Eigen::MatrixXd jacobian;              ///< rows x controls; rows that are not available are NaN
  std::vector<Reliability> reliability;  ///< of each row; by adjoint only
};

/// Simulates up to a time, with no more detail than the problem asks for.
Motion simulateAt(const EditProblem& problem, const Eigen::VectorXd& values, double until);

/// d(rows)/d(values) of a motion simulated at `values`: one reverse pass a row, whatever the number of controls.
Eigen::MatrixXd jacobianByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows, std::vector<Reliability>* reliability = nullptr);
/// The same by one forward pass a control.
Eigen::MatrixXd jacobianByTangent(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& motion,
                                  const RowValues& rows);

RowsAndJacobian evaluateByAdjoint(const EditProblem& problem, const Eigen::VectorXd& values);
RowsAndJacobian evaluateByTangent(const EditProblem& problem, const Eigen::VectorXd& values);

}  // namespace carom
