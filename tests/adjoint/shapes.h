// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <numbers>

#include "adjoint/scene/scene.h"

/// What tests of shapes share.
namespace carom::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

inline CompoundPart part(const Shape& shape, const Vec3& position = Vec3::Zero(), const Quat& q = Quat::Identity()) {
  return {shape, position, q};
}

/// A matrix of a body's own axes in those that the body is turned in.
inline Mat3 turned(const Quat& q, const Mat3& m) { return q.toRotationMatrix() * m * q.toRotationMatrix().transpose(); }

}  // namespace carom::test
