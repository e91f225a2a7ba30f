// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

// Arithmetic without rounding errors, of numbers that neither overflow nor underflow (T. J. Dekker, "A floating-point
// technique for extending the available precision", 1971; D. Knuth, TAOCP 2, 4.2.2). No fused multiply-add: where the
// processor has none, a library would take ten times as long.

namespace carom::elementary {

/// high + low, where low is small against high but need not be below a rounding of it.
struct TwoParts {
  double high, low;
};

/// a + b, where |a| >= |b| or a is zero.
inline TwoParts sumOfOrdered(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

/// a + b.
inline TwoParts sumOf(double a, double b) {
  const double high = a + b, back = high - a;
  return {high, (a - (high - back)) + (b - back)};
}

/// a cut into halves of 26 bits; below 1e300.
inline TwoParts halvesOf(double a) {
  const double shifted = a * 0x1.0000002p27, high = shifted - (shifted - a);
  return {high, a - high};
}

/// a b.
inline TwoParts productOf(double a, double b) {
  const TwoParts u = halvesOf(a), v = halvesOf(b);
  const double high = a * b;
  return {high, ((u.high * v.high - high) + u.high * v.low + u.low * v.high) + u.low * v.low};
}

/// 2^n, -1022 <= n <= 1023.
inline double twoTo(std::int64_t n) { return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52); }

/// a without its last `count` bits.
inline double withoutLastBits(double a, int count) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) & (~std::uint64_t{0} << count));
}

/// The integer nearest to a, |a| < 2^51.
struct Nearest {
  double value;
  std::int64_t integer;
  explicit Nearest(double a) {
    constexpr double kShift = 0x1.8p52;
    const double shifted = a + kShift;
    value = shifted - kShift;
    integer = std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(kShift);
  }
};

/// c[0] + x (c[1] + x (c[2] + ...)).
template <int N>
inline double polynomial(double x, const double (&c)[N]) {
  double value = c[N - 1];
  for (int i = N - 2; i >= 0; --i) value = value * x + c[i];
  return value;
}

}  // namespace carom::elementary
