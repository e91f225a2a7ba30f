// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/scene.h"

namespace carom::adjoint_detail {

/// Normal that the impulse uses, n' = m/|m| with m = n + offset(n, tilt_a) - offset(-n, tilt_b), where for
/// tilt = (alpha, beta): offset(n) = alpha t1 + beta t2, t1 = a - 2 (a.s)/(s.s) s with s = n + m, t2 = n x t1; m and a
/// are constants, at right angles to each other. t1 is a under the minimal rotation from m to n, which is a smooth
/// function of n but at n = -m; on a level floor it is the y axis. Each body's tilt is taken about the normal that points
/// towards that body.
Vec3 tiltedNormal(const Vec3& n, const Vec2& tilt_a, const Vec2& tilt_b);

/// An entry of Scene::tilts; none for -1.
Vec2 tiltOf(const Scene& scene, int entry);

/// How far a frame of n is from the direction where there is none: |n + m|/2, 1 at most; the least of those of n (where
/// `a` has a tilt) and of -n (where `b` has one). Derivatives with respect to n grow with its inverse.
double tiltMargin(const Vec3& n, bool a, bool b);

}  // namespace carom::adjoint_detail
