// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom {

/// Derivative of the rotation vector theta at the end of a stretch of free rotation by theta and L at its start, by the
/// principal moments, and by the products of inertia (yz, xz, xy) in principal axes, which are 0 (every one 3x3). The
/// last one is 0 unless it was asked for.
template <class S>
struct RotationSensitivityOf {
  using Matrix = Eigen::Matrix<S, 3, 3>;          ///< 3x3
  Matrix dtheta_dtheta = Matrix::Identity();      ///< by the rotation vector at the start
  Matrix dtheta_dL = Matrix::Zero();              ///< by the angular momentum
  Matrix dtheta_dI = Matrix::Zero();              ///< by the principal moments
  Matrix dtheta_dproducts = Matrix::Zero();       ///< by the products of inertia
};
using RotationSensitivity = RotationSensitivityOf<double>;

/// Of two stretches, the first and then the second.
RotationSensitivity chained(const RotationSensitivity& first, const RotationSensitivity& second);

/// Of the same stretch with everything in it turned by `turn` (about L, so that L is the same).
RotationSensitivity turned(const RotationSensitivity& S, const Quat& turn);

}  // namespace carom
