// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom {

/// Derivative of the rotation vector theta at the end of a stretch of free rotation by theta and L at its start, by the
/// principal moments, and by the products of inertia (yz, xz, xy) in principal axes, which are 0 (every one 3x3). The
/// last one is 0 unless it was asked for.
struct RotationSensitivity {
  Mat3 dtheta_dtheta = Mat3::Identity();  ///< by the rotation vector at the start
  Mat3 dtheta_dL = Mat3::Zero();          ///< by the angular momentum
  Mat3 dtheta_dI = Mat3::Zero();          ///< by the principal moments
  Mat3 dtheta_dproducts = Mat3::Zero();   ///< by the products of inertia
};

/// Of two stretches, the first and then the second.
RotationSensitivity chained(const RotationSensitivity& first, const RotationSensitivity& second);

/// Of the same stretch with everything in it turned by `turn` (about L, so that L is the same).
RotationSensitivity turned(const RotationSensitivity& S, const Quat& turn);

}  // namespace carom
