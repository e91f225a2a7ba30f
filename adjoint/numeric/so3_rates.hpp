// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"
#include "adjoint/numeric/dual.hpp"

namespace carom::adjoint_detail {

/// c_k(x) = sum over j of (-x)^j/(k + 2j)!, k = 0 to 5: with x = a^2 they are cos a, sin a / a, (1 - cos a)/a^2,
/// (a - sin a)/a^3, and so on. Their slopes are of the same family: c_k' = (k c_(k+2) - c_(k+1))/2.
inline std::array<double, 6> stumpff(double x) {
  std::array<double, 6> c;
  if (x < 1) {
    double factorial = 1;
    for (int k = 0; k < 6; ++k) {
      factorial *= k > 0 ? k : 1;
      double sum = 1;
      for (int j = 10; j >= 1; --j) sum = 1 - x / ((k + 2 * j - 1) * (k + 2 * j)) * sum;
      c[static_cast<std::size_t>(k)] = sum / factorial;
    }
    return c;
  }
  const double a = std::sqrt(x), half_sine = elementary::sin(0.5 * a);
  const auto [sine, cosine] = elementary::sincos(a);
  c[0] = cosine;
  c[1] = sine / a;
  c[2] = 2 * half_sine * half_sine / x;
  c[3] = (a - sine) / (a * x);
  c[4] = (0.5 - c[2]) / x;
  c[5] = (1.0 / 6 - c[3]) / x;
  return c;
}

/// exp([a]x) = 1 + c_1 [a]x + c_2 [a]x^2, and the left Jacobian J = 1 + c_2 [a]x + c_3 [a]x^2, in dual numbers S.
template <class S>
struct DualTurn {
  M3<S> E, J;
  explicit DualTurn(const V3<S>& a) {
    const S x = a.squaredNorm();
    const std::array<double, 6> c = stumpff(x.value);
    const S c1 = x.chain(c[1], 0.5 * (c[3] - c[2])), c2 = x.chain(c[2], c[4] - 0.5 * c[3]),
            c3 = x.chain(c[3], 0.5 * (3 * c[5] - c[4]));
    const M3<S> U = skew(a), U2 = U * U;
    E = M3<S>::Identity() + c1 * U + c2 * U2;
    J = M3<S>::Identity() + c2 * U + c3 * U2;
  }
};

/// Rate of leftJacobian(u) as u changes at du.
inline Mat3 leftJacobianRate(const Vec3& u, const Vec3& du) {
  V3<Dual<1>> a = u.cast<Dual<1>>();
  setRates(a, du, 0);
  return ratesOf(DualTurn<Dual<1>>(a).J, 0);
}

}  // namespace carom::adjoint_detail
