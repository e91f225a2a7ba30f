// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "adjoint/base/types.h"
#include "tests/support/exact/vector.h"

namespace carom::brute {

/// The numbers of the independent check: long double, so that its own rounding stays far below what it measures.
using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;
using Rotation = Eigen::Quaternion<Real>;

inline Vector widen(const Vec3& v) { return v.cast<Real>(); }
inline Vector widen(const exact::Vec<Real>& v) { return {v[0], v[1], v[2]}; }
inline exact::Vec<Real> exactly(const Vector& v) { return {v[0], v[1], v[2]}; }
inline exact::Mat<Real> exactly(const Matrix& m) {
  return {{exactly(Vector(m.col(0))), exactly(Vector(m.col(1))), exactly(Vector(m.col(2)))}};
}

}  // namespace carom::brute
