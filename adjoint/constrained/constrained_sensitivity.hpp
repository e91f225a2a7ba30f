// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_start_derivative.hpp"

namespace carom::adjoint_detail {

/// Derivative of the state (x, theta, v, L) of a path at a fixed time by its inputs, 12 rows: the collocation of its steps,
/// differentiated, from a start whose gaps and slips stay what they are (11.24).
Eigen::MatrixXd constrainedSensitivity(const ConstrainedPath& path, const ConstrainedInputs& inputs, double t);

/// Of the guard that ends a path, by the state there and the other inputs.
ConstrainedRow guardRow(const ConstrainedPath& path, const ConstrainedInputs& inputs, ConstrainedGuard guard, double t);

}  // namespace carom::adjoint_detail
