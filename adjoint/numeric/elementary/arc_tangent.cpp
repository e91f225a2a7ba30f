// SPDX-License-Identifier: MIT
#include <cmath>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/elementary/constants.hpp"
#include "adjoint/numeric/elementary/two_parts.hpp"

namespace carom::elementary {
namespace {

/// atan(n/d), 0 < n <= d, both within 1e-290 and 1e290.
TwoParts arcTangentOfRatio(double n, double d) {
  const double ratio = n / d;
  if (ratio < 0.125) {
    const TwoParts back = productOf(ratio, d);
    const double rest = ((n - back.high) - back.low) / d, z = ratio * ratio;
    const double bend = polynomial(
        z, {-1. / 3, 1. / 5, -1. / 7, 1. / 9, -1. / 11, 1. / 13, -1. / 15, 1. / 17, -1. / 19});
    return {ratio, ratio * z * bend + (rest - rest * z)};
  }
  // atan(n/d) = atan(c) + atan((n - c d)/(d + c n)), c = j/64
  const Nearest j(64 * ratio);
  const double c = j.value / 64, d_high = withoutLastBits(d, 27);
  const double t = ((n - c * d_high) - c * (d - d_high)) / (d + c * n), z = t * t;
  const double* row = kArcTangents[j.integer];
  return {row[0], row[1] + (t + t * z * polynomial(z, {-1. / 3, 1. / 5, -1. / 7}))};
}

/// base + sign a.
double added(const TwoParts& base, double sign, const TwoParts& a) {
  const TwoParts sum = sumOfOrdered(base.high, sign * a.high);
  return sum.high + (sum.low + (base.low + sign * a.low));
}

/// The angle of (x, y), both positive and finite, and of (-x, y) where `left`.
double positiveAngle(double y, double x, bool left) {
  constexpr TwoParts kZero = {0, 0}, kQuarter = {kHalfPi[0], kHalfPi[1]};
  constexpr TwoParts kHalf = {2 * kHalfPi[0], 2 * kHalfPi[1]};
  const bool steep = y > x;
  double n = steep ? x : y, d = steep ? y : x;
  TwoParts angle;
  if (n / d < 0x1p-60) {
    if (!steep && !left) return y / x;
    angle = {n / d, 0};
  } else {
    if (d > 0x1p900 || n < 0x1p-900) {
      int exponent = 0;
      d = std::frexp(d, &exponent);
      n = std::ldexp(n, -exponent);
    }
    angle = arcTangentOfRatio(n, d);
  }
  if (steep) return added(kQuarter, left ? 1 : -1, angle);
  return left ? added(kHalf, -1, angle) : added(kZero, 1, angle);
}

/// The same where one of the two is zero or infinite.
double extremeAngle(double y, double x, bool left) {
  if (std::isinf(x) && std::isinf(y)) return (left ? 1.5 : 0.5) * kHalfPi[0];
  if (x == 0 ? y != 0 : std::isinf(y)) return kHalfPi[0];
  return left ? 2 * kHalfPi[0] : 0;
}

}  // namespace

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double up = std::abs(y), side = std::abs(x);
  const bool left = std::signbit(x), extreme = up == 0 || side == 0 || std::isinf(up) || std::isinf(side);
  return std::copysign(extreme ? extremeAngle(up, side, left) : positiveAngle(up, side, left), y);
}

}  // namespace carom::elementary
