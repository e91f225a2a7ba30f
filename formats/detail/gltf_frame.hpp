// Private to formats/*.cpp.
#pragma once

#include "formats/detail/gltf_nodes.hpp"

namespace carom::gltf {

/// What a chain of nodes does to a point: p_outer = translation + rotation * (stretch p). The stretch is a multiple of
/// the identity or diagonal wherever the chain allows it.
///
/// Composition is exact where it can be: a rotation by 0, and one and its opposite (z up to y up and back, round shapes
/// along y and along z) leave numbers as they are, bit by bit. So poses that went out come back.
struct Frame {
  Quat rotation = Quat::Identity();
  Vec3 translation = Vec3::Zero();
  Mat3 stretch = Mat3::Identity();
};

/// glTF's axes to ours, (x, y, z) -> (x, -z, y), as the frame of the root nodes.
Frame zUpFrame();
Frame inside(const Frame& outer, const PhysicsNode& node);

/// A unit quaternion is kept as it is, to the last bits; another is normalized.
Quat unitQuaternion(const Quat& q);
/// a b; the identity when the two cancel up to rounding.
Quat product(const Quat& a, const Quat& b);
/// q v, where quarter turns only exchange coordinates.
Vec3 turned(const Quat& q, const Vec3& v);

/// Quarter turns about x: y to z (as z up from y up), and z to y.
Quat yToZ();
Quat zToY();

}  // namespace carom::gltf
