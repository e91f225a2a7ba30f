// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/group/group_start_derivative.hpp"

namespace carom::adjoint_detail {

/// Derivative of the states (x, theta, v, L) of all members at a fixed time by the inputs of their path, 12 rows each: the collocation of its
/// steps, differentiated, from a start whose gaps and slips stay what they are.
Eigen::MatrixXd groupSensitivity(const GroupPath& path, const GroupInputs& inputs, double t);

/// Of the guard that ends the path, by the states there and the other inputs.
Eigen::RowVectorXd guardRow(const GroupPath& path, const GroupInputs& inputs, ConstrainedGuard guard, double t);

}  // namespace carom::adjoint_detail
