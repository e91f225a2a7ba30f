// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {

/// Below it series are used, in so many terms.
inline constexpr double kSeriesOfRates = 1.5;
inline constexpr int kRateTerms = 11;

/// Of leftJacobian(u) y with respect to u:
///   b [-y]x + c ([u x -y]x - [u]x [y]x) + ([u]x y b' + [u]x^2 y c') u^T / a
inline Mat3 leftJacobianRate(const Vec3& u, const Vec3& y) {
  const double a2 = u.squaredNorm(), a = std::sqrt(a2);
  double b = 0, c = 0, db = 0, dc = 0;  // the last two over a
  if (a < kSeriesOfRates) {
    double term = 0.5;  // (-1)^k a^(2k) / (2k + 2)!
    for (int k = 0; k < kRateTerms; ++k) {
      b += term, c += term / (2 * k + 3);
      term /= -((2 * k + 3) * (2 * k + 4));
      db += 2 * (k + 1) * term, dc += 2 * (k + 1) * term / (2 * k + 5);
      term *= a2;
    }
  } else {
    const auto [sine, cosine] = elementary::sincos(a);
    b = (1 - cosine) / a2, c = (a - sine) / (a2 * a);
    db = (sine / a - 2 * b) / a2, dc = (b - 3 * c) / a2;
  }
  const Mat3 U = skew(u), Y = skew(y);
  const Vec3 once = u.cross(y), twice = u.cross(once);
  return -b * Y - c * (skew(once) + U * Y) + (db * once + dc * twice) * u.transpose();
}

}  // namespace carom::adjoint_detail
