// SPDX-License-Identifier: MIT
#include "formats/gltf/axes.hpp"

#include <cmath>

#include "formats/base/unit.hpp"

namespace carom::gltf {

Quat product(const Quat& a, const Quat& b) {
  const Quat q = a * b;
  return q.vec().norm() <= formats_detail::kUnitRounding ? Quat::Identity() : formats_detail::unitQuaternion(q);
}

Mat3 matrixOf(const Quat& q) {
  return q.toRotationMatrix().unaryExpr([](double x) {
    const double whole = std::round(x);  // -1, 0 or 1
    return std::abs(x - whole) <= formats_detail::kUnitRounding ? whole : x;
  });
}

Vec3 turned(const Quat& q, const Vec3& v) { return matrixOf(q) * v; }

// 0 - x has no negative zeros, which would be written as "-0.0".
Vec3 zUp(const Vec3& v) { return {v.x(), 0 - v.z(), v.y()}; }
Vec3 yUp(const Vec3& v) { return {v.x(), v.z(), 0 - v.y()}; }
Quat zUp(const Quat& q) { return {q.w(), q.x(), 0 - q.z(), q.y()}; }
Quat yUp(const Quat& q) { return {q.w(), q.x(), q.z(), 0 - q.y()}; }
Vec3 swappedSizes(const Vec3& sizes) { return {sizes.x(), sizes.z(), sizes.y()}; }

}  // namespace carom::gltf
