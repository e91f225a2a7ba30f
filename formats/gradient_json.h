#pragma once

#include <string>

#include "editing/jacobian.h"

namespace carom {

/// "velocity.x", "size.radius", "elasticity": a control's number in the words of the scene document.
std::string columnName(const ControlSet& controls, int variable);

/// The answer of `carom gradient --json`: rows {constraint, component, value, target}, columns {control, component,
/// value}, jacobian (by rows), signature, reliable, message. `constraint` and `control` are indices into the lists of
/// the scene document. `values` are those of the controls at which `result` was evaluated.
std::string gradientJson(const EditProblem& problem, const Eigen::VectorXd& values, const RowsAndJacobian& result,
                         bool reliable, const std::string& message);

}  // namespace carom
