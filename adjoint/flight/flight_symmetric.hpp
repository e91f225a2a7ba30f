// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/flight/rotation_sensitivity.h"

namespace carom::adjoint_detail {

/// Free rotation with equal moments I: R(t) = exp([L t / I]x) R0. dtheta_dI is right for changes that keep the three
/// moments equal.
Quat sphericalOrientation(double inertia, const Quat& q0, const Vec3& L, double t);
RotationSensitivity sphericalSensitivity(double inertia, const Vec3& L, double t);

/// Free rotation with two equal moments, `axis` the body axis (0, 1, 2) of the other:
///   R(t) = exp([L t / I_perp]x) R0 exp([(1/I_par - 1/I_perp) (L . R0 e) t e]x),  e = e_axis.
/// dtheta_dI is right for changes that keep the two moments equal.
Quat symmetricOrientation(const Vec3& inertia, int axis, const Quat& q0, const Vec3& L, double t);
RotationSensitivity symmetricSensitivity(const Vec3& inertia, int axis, const Quat& q0, const Vec3& L, double t);

/// The axis whose moment differs from the other two, which are equal to rounding; -1: all equal; 3: all differ.
int symmetryAxis(const Vec3& inertia);

}  // namespace carom::adjoint_detail
