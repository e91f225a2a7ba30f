// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {

/// Rate of leftJacobian(u) = 1 + c_2 U + c_3 U^2 as u changes at du, U = [u]x, x = |u|^2:
///   dJ = dc_2 U + c_2 dU + dc_3 U^2 + c_3 (U dU + dU U),  dc_k = c_k' 2 u.du,
/// of the functions c_k(x) = sum over j of (-x)^j/(k + 2j)!, whose slopes are c_k' = (k c_(k+2) - c_(k+1))/2.
inline Mat3 leftJacobianRate(const Vec3& u, const Vec3& du) {
  const double x = u.squaredNorm();
  double c[6] = {};
  if (x < 1) {
    double factorial = 1;
    for (int k = 0; k < 6; ++k) {
      if (k > 0) factorial *= k;
      double sum = 1;
      for (int j = 10; j >= 1; --j) sum = 1 - x / ((k + 2 * j - 1) * (k + 2 * j)) * sum;
      c[k] = sum / factorial;
    }
  } else {
    const double a = std::sqrt(x), half_sine = elementary::sin(0.5 * a);
    c[2] = 2 * half_sine * half_sine / x;
    c[3] = (a - elementary::sin(a)) / (a * x);
    c[4] = (0.5 - c[2]) / x;
    c[5] = (1.0 / 6 - c[3]) / x;
  }
  const double dx = 2 * u.dot(du), db = 0.5 * (2 * c[4] - c[3]) * dx, dc = 0.5 * (3 * c[5] - c[4]) * dx;
  const Mat3 U = skew(u), dU = skew(du);
  return db * U + c[2] * dU + dc * U * U + c[3] * (U * dU + dU * U);
}

}  // namespace carom::adjoint_detail
