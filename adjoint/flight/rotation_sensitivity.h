// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom {

/// Derivative of the rotation vector theta at the end of a free rotation with respect to theta and L at its start,
/// the principal moments, and the products of inertia (yz, xz, xy) in principal axes, whose values are 0 (3x3 each).
/// The last one is 0 unless it was requested.
template <class S>
struct RotationSensitivityOf {
  using Matrix = Eigen::Matrix<S, 3, 3>;          ///< 3x3
  Matrix dtheta_dtheta = Matrix::Identity();      ///< with respect to the rotation vector at the start
  Matrix dtheta_dL = Matrix::Zero();              ///< with respect to the angular momentum
  Matrix dtheta_dI = Matrix::Zero();              ///< with respect to the principal moments
  Matrix dtheta_dproducts = Matrix::Zero();       ///< with respect to the products of inertia
};
using RotationSensitivity = RotationSensitivityOf<double>;  ///< in doubles

/// Of two segments in succession.
RotationSensitivity chained(const RotationSensitivity& first, const RotationSensitivity& second);

/// Of the same segment rotated as a whole by `turn` (about L, so that L does not change).
RotationSensitivity turned(const RotationSensitivity& S, const Quat& turn);

}  // namespace carom
