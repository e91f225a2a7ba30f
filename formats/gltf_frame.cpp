#include "formats/detail/gltf_frame.hpp"

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

Quat yToZ() { return {std::sqrt(0.5), std::sqrt(0.5), 0, 0}; }
Quat zToY() { return {std::sqrt(0.5), -std::sqrt(0.5), 0, 0}; }

Frame zUpFrame() {
  Frame frame;
  frame.rotation = yToZ();
  return frame;
}

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
