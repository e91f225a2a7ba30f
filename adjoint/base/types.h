// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace carom {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Skew-symmetric matrix [a]x, so that [a]x b = a x b.
inline Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// The vector d with <M, [d]x> = d . unskew(M) for every d (the adjoint of `skew`).
inline Vec3 unskew(const Mat3& m) { return {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)}; }

}  // namespace carom
