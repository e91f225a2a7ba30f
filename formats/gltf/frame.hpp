// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include "formats/gltf/nodes.hpp"

namespace carom::gltf {

/// What a chain of nodes does to a point: p_outer = translation + rotation * (stretch p). The stretch is a multiple of
/// the identity or diagonal wherever the chain allows it.
///
/// Composition is exact where it can be: a rotation by 0, and one and its opposite leave numbers as they are, bit by bit.
/// So poses that went out come back.
struct Frame {
  Quat rotation = Quat::Identity();
  Vec3 translation = Vec3::Zero();
  Mat3 stretch = Mat3::Identity();
};

Frame inside(const Frame& outer, const PhysicsNode& node);

/// A unit quaternion is kept as it is, to the last bits; another is normalized.
Quat unitQuaternion(const Quat& q);
/// a b; the identity when the two cancel up to rounding.
Quat product(const Quat& a, const Quat& b);
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
