// SPDX-License-Identifier: MIT
// Private to formats/*.cpp. Turns and axes, exact where they can be.
#pragma once

#include "adjoint/base/types.h"

namespace carom::gltf {

/// a b; the identity when the two cancel up to rounding.
Quat product(const Quat& a, const Quat& b);
/// Of a unit quaternion; entries that are whole numbers up to rounding are.
Mat3 matrixOf(const Quat& q);
/// q v, where quarter turns only exchange coordinates.
Vec3 turned(const Quat& q, const Vec3& v);

/// glTF's axes, y up, to ours, z up: (x, y, z) -> (x, -z, y), for points and vectors and for the axes of every node, so
/// that a rotation is turned along. Exact. yUp is the way back.
Vec3 zUp(const Vec3& v);
Vec3 yUp(const Vec3& v);
Quat zUp(const Quat& q);
Quat yUp(const Quat& q);
/// The same for what goes by axis without a sign: sizes, scales, moments. Its own inverse.
Vec3 swappedSizes(const Vec3& sizes);

}  // namespace carom::gltf
