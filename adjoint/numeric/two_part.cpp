// SPDX-License-Identifier: MIT
#include "adjoint/numeric/two_part.hpp"

#include "adjoint/numeric/double_double.hpp"

namespace carom::adjoint_detail {
namespace {

using Exact = Eigen::Matrix<DoubleDouble, 3, 1>;

// Without error.
Exact difference(const Vec3& a, const Vec3& o) { return a.cast<DoubleDouble>() - o.cast<DoubleDouble>(); }

}  // namespace

Vec3 crossProduct(const Vec3& o, const Vec3& a, const Vec3& b) {
  return difference(a, o).cross(difference(b, o)).cast<double>();
}

double tripleProduct(const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c) {
  return difference(a, o).dot(difference(b, o).cross(difference(c, o))).high;
}

}  // namespace carom::adjoint_detail
