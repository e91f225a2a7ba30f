#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "adjoint/types.h"

namespace carom::brute {

/// The numbers of the independent check: long double, so that its own rounding stays far below what it measures.
using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Matrix = Eigen::Matrix<Real, 3, 3>;
using Rotation = Eigen::Quaternion<Real>;

inline Vector widen(const Vec3& v) { return v.cast<Real>(); }

}  // namespace carom::brute
