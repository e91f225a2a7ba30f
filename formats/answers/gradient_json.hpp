// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/problem/jacobian.hpp"

namespace carom::formats_detail {

using namespace editing_detail;

/// The answer of `carom gradient --json`: rows {constraint, component, name, value, target}, times {constraint, from, to,
/// time}, columns {control, component, name, value}, jacobian (by rows), signature, reliable, message. A row that is held
/// within a range has the target null, and min and max (null on an open side). Rows of a constraint `between` two times
/// are read, and derived, at the time that stands in `times`. `constraint` and `control` are indices into the lists of
/// the scene document. `values` are those of the controls at which `result` was evaluated.
std::string gradientJson(const EditProblem& problem, const Eigen::VectorXd& values, const RowsAndJacobian& result,
                         bool reliable, const std::string& message);

}  // namespace carom::formats_detail
