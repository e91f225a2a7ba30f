// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/elementary/constants.hpp"
#include "adjoint/numeric/elementary/two_parts.hpp"

namespace carom::elementary {

double cbrt(double x) {
  if (x == 0 || !std::isfinite(x)) return x + x;
  double size = std::abs(x);
  std::int64_t exponent = -1023;
  if (size < 0x1p-1022) size *= 0x1p54, exponent -= 54;
  const auto bits = std::bit_cast<std::uint64_t>(size);
  exponent += static_cast<std::int64_t>(bits >> 52);
  const std::int64_t third = (exponent + 1200) / 3 - 400, left = exponent - 3 * third;
  const double m = std::bit_cast<double>((bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1023} << 52));
  const double cube = m * twoTo(left);  // in [1, 8)

  // A parabola through three points of the curve (error 1/1000), one step of Halley's method, 17 bits of that.
  double root = polynomial(m, {0.6257, 0.4336, -0.0584}) * kCubeRoots[left];
  const double third_power = root * root * root;
  root = withoutLastBits(root * (third_power + 2 * cube) / (2 * third_power + cube), 36);

  // cube = root^3 (1 + e); the cube of 17 bits has no rounding error.
  const double whole = root * root * root, e = (cube - whole) / whole;
  root += root * e * polynomial(e, {1. / 3, -1. / 9, 5. / 81});
  return std::copysign(root * twoTo(third), x);
}

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return HUGE_VAL;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  double a = std::max(std::abs(x), std::abs(y)), b = std::min(std::abs(x), std::abs(y)), scale = 1;
  if (b <= a * 0x1p-60) return a + b;
  if (a > 0x1p500) {
    a *= 0x1p-600, b *= 0x1p-600, scale = 0x1p600;
  } else if (b < 0x1p-450) {
    a *= 0x1p600, b *= 0x1p600, scale = 0x1p-600;
  }
  const TwoParts aa = productOf(a, a), bb = productOf(b, b), sum = sumOfOrdered(aa.high, bb.high);
  const double root = std::sqrt(sum.high);
  const TwoParts back = productOf(root, root);
  const double left = ((sum.high - back.high) - back.low) + (sum.low + (aa.low + bb.low));
  return (root + left / (2 * root)) * scale;
}

}  // namespace carom::elementary
