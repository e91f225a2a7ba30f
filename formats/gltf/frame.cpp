// SPDX-License-Identifier: MIT
#include "formats/gltf/frame.hpp"

#include <cmath>

namespace carom::gltf {
namespace {

constexpr double kUnitRounding = 1e-15;

Mat3 matrixOf(const Quat& q) {
  return q.toRotationMatrix().unaryExpr([](double x) {
    const double whole = std::round(x);  // -1, 0 or 1
    return std::abs(x - whole) <= kUnitRounding ? whole : x;
  });
}

bool isMultipleOfIdentity(const Mat3& m) { return m == Mat3(m(0, 0) * Mat3::Identity()); }

}  // namespace

Quat unitQuaternion(const Quat& q) {
  // Twice: once is not always exact to the last bit but one.
  return std::abs(q.squaredNorm() - 1) > kUnitRounding ? q.normalized().normalized() : q;
}

Quat product(const Quat& a, const Quat& b) {
  const Quat q = a * b;
  return q.vec().norm() <= kUnitRounding ? Quat::Identity() : unitQuaternion(q);
}

Vec3 turned(const Quat& q, const Vec3& v) { return matrixOf(q) * v; }

// 0 - x has no negative zeros, which would be written as "-0.0".
Vec3 zUp(const Vec3& v) { return {v.x(), 0 - v.z(), v.y()}; }
Vec3 yUp(const Vec3& v) { return {v.x(), v.z(), 0 - v.y()}; }
Quat zUp(const Quat& q) { return {q.w(), q.x(), 0 - q.z(), q.y()}; }
Quat yUp(const Quat& q) { return {q.w(), q.x(), q.z(), 0 - q.y()}; }
Vec3 swappedSizes(const Vec3& sizes) { return {sizes.x(), sizes.z(), sizes.y()}; }

Frame inside(const Frame& outer, const PhysicsNode& node) {
  Frame frame;
  frame.translation = outer.translation + turned(outer.rotation, outer.stretch * node.translation);
  frame.rotation = product(outer.rotation, node.rotation);
  const Mat3 R = matrixOf(node.rotation);
  // outer.rotation S R = (outer.rotation R) (R^T S R)
  const Mat3 stretch = isMultipleOfIdentity(outer.stretch) ? outer.stretch : Mat3(R.transpose() * outer.stretch * R);
  frame.stretch = stretch * node.scale.asDiagonal();
  return frame;
}

}  // namespace carom::gltf
