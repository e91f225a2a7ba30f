// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/elementary/constants.hpp"
#include "adjoint/numeric/elementary/exponential.hpp"
#include "adjoint/numeric/elementary/two_parts.hpp"

namespace carom::elementary {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

/// x = 2^exponent m, c m = 1 + r: log(x) = exponent log(2) - log(c) + log(1 + r); |r| <= 2^-7.
struct Reduced {
  double main, rest;  // exponent log(2) - log(c)
  TwoParts r;         // without error

  /// x is positive and finite.
  explicit Reduced(double x) {
    constexpr std::uint64_t kMantissa = (std::uint64_t{1} << 52) - 1;
    std::int64_t exponent = -1023;
    if (x < 0x1p-1022) x *= 0x1p54, exponent -= 54;
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t row = (bits >> 45) & 127, halved = row >= 53 ? 1 : 0;
    exponent += static_cast<std::int64_t>((bits >> 52) + halved);
    const double m = std::bit_cast<double>((bits & kMantissa) | ((1023 - halved) << 52));
    const double c = kLogs[row][0], m_high = withoutLastBits(m, 21), k = static_cast<double>(exponent);
    r = sumOf(m_high * c - 1, (m - m_high) * c);
    main = k * kLogOfTwo[0] + kLogs[row][1];  // no rounding: both are multiples of 2^-42
    rest = k * kLogOfTwo[1] + kLogs[row][2];
  }
};

/// log(x) in two parts, error below 2^-67 of it.
TwoParts accurateLog(double x) {
  const Reduced a(x);
  const double r = a.r.high;
  const double cube = r * r * r *
                      polynomial(r, {1. / 3, -1. / 4, 1. / 5, -1. / 6, 1. / 7, -1. / 8, 1. / 9, -1. / 10, 1. / 11});
  const TwoParts square = productOf(r, r);
  const TwoParts first = sumOfOrdered(a.main, r), second = sumOfOrdered(first.high, -0.5 * square.high);
  const double low =
      cube + (a.rest + (a.r.low - r * a.r.low) - 0.5 * square.low + second.low + first.low);
  return sumOfOrdered(second.high, low);
}

/// log of what is not positive and finite.
double irregularLog(double x) {
  if (x == 0) return -kInfinity;
  return x < 0 ? kUndefined : x;  // infinity, or not a number
}

bool positiveAndFinite(double x) { return x > 0 && x < kInfinity; }

bool isInteger(double y) { return std::abs(y) >= 0x1p52 || std::floor(y) == y; }
bool isOdd(double y) { return std::abs(y) < 0x1p53 && isInteger(y) && std::fmod(y, 2) != 0; }

/// x^y where x is zero or infinite, y neither zero nor NaN; `sign` is that of an odd power.
double powerOfExtreme(double x, double y, double sign) {
  return sign * ((std::abs(x) < 1) == (y > 0) ? 0 : kInfinity);
}

/// x^y of positive finite x other than 1.
double positivePower(double x, double y) {
  if (std::abs(y) > 0x1p65) return (x > 1) == (y > 0) ? kInfinity : 0;  // |log(x)| > 2^-54
  if (std::abs(y) < 0x1p-65) return 1;
  const TwoParts log_x = accurateLog(x);
  const TwoParts product = productOf(y, log_x.high);
  if (product.high > 710) return kInfinity;
  if (product.high < -746) return 0;
  return rounded(exponentialOf(product.high, product.low + y * log_x.low));
}

}  // namespace

double log(double x) {
  if (!positiveAndFinite(x)) return irregularLog(x);
  const Reduced a(x);
  const double r = a.r.high;
  const double bend =
      r * r * polynomial(r, {-1. / 2, 1. / 3, -1. / 4, 1. / 5, -1. / 6, 1. / 7, -1. / 8, 1. / 9});  // log(1 + r) - r
  const TwoParts sum = sumOfOrdered(a.main, r);
  return sum.high + (sum.low + (a.r.low + a.rest + bend));
}

double log10(double x) {
  if (!positiveAndFinite(x)) return irregularLog(x);
  const TwoParts log_x = accurateLog(x), product = productOf(log_x.high, kOverLogOfTen[0]);
  return product.high + (product.low + (log_x.high * kOverLogOfTen[1] + log_x.low * kOverLogOfTen[0]));
}

double pow(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  if (std::isinf(y)) {
    if (std::abs(x) == 1) return 1;
    return (std::abs(x) > 1) == (y > 0) ? kInfinity : 0;
  }
  const double sign = std::signbit(x) && isOdd(y) ? -1 : 1;
  if (x == 0 || std::isinf(x)) return powerOfExtreme(x, y, sign);
  if (x < 0 && !isInteger(y)) return kUndefined;
  return x == -1 ? sign : sign * positivePower(std::abs(x), y);
}

}  // namespace carom::elementary
