// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "adjoint/base/small_matrices.h"

namespace carom {

using Vec2 = Eigen::Vector2d;     ///< two numbers
using Vec3 = Eigen::Vector3d;     ///< three numbers, in the axes that its name says
using Mat3 = Eigen::Matrix3d;     ///< 3x3
using Quat = Eigen::Quaterniond;  ///< unit quaternion of a rotation, (w, x, y, z)

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();  ///< of a double

/// Skew-symmetric matrix [a]x, so that [a]x b = a x b, for any scalar type.
template <class Vector>
Eigen::Matrix<typename Vector::Scalar, 3, 3> skew(const Eigen::MatrixBase<Vector>& vector) {
  using S = typename Vector::Scalar;
  const Eigen::Matrix<S, 3, 1> a = vector;
  Eigen::Matrix<S, 3, 3> m;
  m << S(0), -a.z(), a.y(), a.z(), S(0), -a.x(), -a.y(), a.x(), S(0);
  return m;
}

/// The vector d with <M, [d]x> = d . unskew(M) for every d (the adjoint of `skew`).
template <class Matrix>
Eigen::Matrix<typename Matrix::Scalar, 3, 1> unskew(const Eigen::MatrixBase<Matrix>& matrix) {
  const Eigen::Matrix<typename Matrix::Scalar, 3, 3> m = matrix;
  return {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
}

}  // namespace carom
