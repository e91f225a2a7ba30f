// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/types.h"

namespace carom {

/// Normal that the impulse uses, n' = m/|m| with m = n + offset(n, tilt_a) - offset(-n, tilt_b), where for
/// tilt = (alpha, beta): offset(n) = alpha t1 + beta t2, t1 = n x e_k/|n x e_k|, t2 = n x t1, e_k the coordinate axis
/// with the smallest |n_k| (lowest k on a tie). Each body's tilt is taken about the normal that points towards that
/// body.
Vec3 tiltedNormal(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b);

/// d n' by (n, tilt_a, tilt_b): 3 x 7.
Eigen::Matrix<double, 3, 7> tiltedNormalJacobian(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b);

}  // namespace carom
