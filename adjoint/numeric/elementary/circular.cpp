// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/elementary/constants.hpp"
#include "adjoint/numeric/elementary/two_parts.hpp"

namespace carom::elementary {
namespace {

constexpr double kEighthTurn = 0x1.921fb54442d18p-1;  // pi/4
constexpr double kFewTurns = 0x1p20;                  // up to there three parts of pi/2 are enough,
constexpr double kLeastRest = 0x1p-20;                // and if less than that is left, not even they

/// x = quarters pi/2 + rest, |rest| <= pi/4 but for a rounding.
struct Turned {
  TwoParts rest;
  std::int64_t quarters;  // modulo 4 only
};

/// The exact way: x = m 2^e with a whole m, times 256 bits of 2/pi, modulo 4. Bits of 2/pi above them give multiples of
/// 4.
Turned turnedByBits(double x) {
  int exponent = 0;
  const double fraction = std::frexp(std::abs(x), &exponent);
  const auto m = static_cast<std::uint64_t>(fraction * 0x1p53);
  exponent -= 53;
  const int first = std::max(0, (exponent - 2) / 32);
  const int point = 32 * (first + 8) - exponent;  // so many bits of the product are after the point

  std::uint32_t product[11] = {};  // the lowest first
  for (int i = 0; i < 8; ++i) {
    std::uint64_t carry = 0;
    const std::uint64_t word = kTwoOverPiBits[first + 7 - i], halves[2] = {m & 0xffffffff, m >> 32};
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t sum = product[i + k] + carry + (k < 2 ? word * halves[k] : 0);
      product[i + k] = static_cast<std::uint32_t>(sum), carry = sum >> 32;
    }
  }
  // 32 bits from bit `from` on
  const auto bitsFrom = [&](int from) {
    const int word = from / 32;
    const std::uint64_t two = product[word] | static_cast<std::uint64_t>(product[word + 1]) << 32;
    return static_cast<std::uint32_t>(two >> (from % 32));
  };
  std::int64_t quarters = bitsFrom(point) & 3;
  const bool up = (bitsFrom(point - 32) >> 31) != 0;  // at least a half: the next quarter is nearer
  if (up) ++quarters;
  double high = 0, low = 0, unit = 0x1p-32;
  for (int k = 1; k <= 6; ++k, unit *= 0x1p-32) {
    const std::uint32_t bits = bitsFrom(point - 32 * k);
    const TwoParts sum = sumOf(high, static_cast<double>(up ? ~bits : bits) * unit);
    high = sum.high, low += sum.low;
  }
  const TwoParts quarter = sumOfOrdered(high, low), turn = productOf(quarter.high, kHalfPi[0]);
  const TwoParts rest =
      sumOfOrdered(turn.high, turn.low + (quarter.high * kHalfPi[1] + quarter.low * kHalfPi[0]));
  const double sign = up ? -1 : 1;
  if (x < 0) return {{-sign * rest.high, -sign * rest.low}, -quarters};
  return {{sign * rest.high, sign * rest.low}, quarters};
}

/// x is finite.
inline Turned turned(double x) {
  if (std::abs(x) <= kEighthTurn) return {{x, 0}, 0};
  if (std::abs(x) < kFewTurns) {
    const Nearest n(x * kTwoOverPi);
    const TwoParts second = sumOf(x - n.value * kQuarterTurn[0], -(n.value * kQuarterTurn[1]));
    const TwoParts rest = sumOfOrdered(second.high, second.low - n.value * kQuarterTurn[2]);
    if (std::abs(rest.high) >= kLeastRest) return {rest, n.integer};
  }
  return turnedByBits(x);
}

/// A point j/64 of the table near |a| and what is left.
struct Near {
  const double* row;  // sine and cosine of the point
  double t, sine, cosine;  // sine = sin(t) - t, cosine = cos(t) - 1

  explicit Near(const TwoParts& a) {
    const double size = std::abs(a.high);
    const Nearest j(64 * size);
    row = kSinesCosines[j.integer];
    t = (size - j.value / 64) + (a.high < 0 ? -a.low : a.low);
    const double z = t * t;
    sine = t * z * polynomial(z, {-1. / 6, 1. / 120, -1. / 5040});
    cosine = z * polynomial(z, {-1. / 2, 1. / 24, -1. / 720});
  }
};

inline double sineBySeries(const TwoParts& a) {
  const double z = a.high * a.high;
  const double bend =
      polynomial(z, {-1. / 6, 1. / 120, -1. / 5040, 1. / 362880, -1. / 39916800, 1. / 6227020800});
  return a.high + (a.low + a.high * z * bend);
}

inline double sineNear(const TwoParts& a, const Near& p) {
  const double size = p.row[0] + (p.row[1] + (p.row[2] * p.t + (p.row[2] * p.sine + p.row[0] * p.cosine)));
  return std::copysign(size, a.high);
}

inline double cosineNear(const Near& p) {
  return p.row[2] + (p.row[3] + (p.row[2] * p.cosine - p.row[0] * p.sine - p.row[0] * p.t));
}

constexpr double kSeries = 0.25;  // sines up to there are summed from zero

inline double sineOf(const TwoParts& a) { return std::abs(a.high) < kSeries ? sineBySeries(a) : sineNear(a, Near(a)); }
inline double cosineOf(const TwoParts& a) { return cosineNear(Near(a)); }

}  // namespace

double sin(double x) {
  if (!std::isfinite(x)) return x - x;
  if (x == 0) return x;
  const Turned a = turned(x);
  const double value = a.quarters & 1 ? cosineOf(a.rest) : sineOf(a.rest);
  return a.quarters & 2 ? -value : value;
}

double cos(double x) {
  if (!std::isfinite(x)) return x - x;
  const Turned a = turned(x);
  const double value = a.quarters & 1 ? sineOf(a.rest) : cosineOf(a.rest);
  return (a.quarters + 1) & 2 ? -value : value;
}

SineCosine sincos(double x) {
  if (!std::isfinite(x)) return {x - x, x - x};
  if (x == 0) return {x, 1};
  const Turned a = turned(x);
  const Near near(a.rest);
  const double sine = std::abs(a.rest.high) < kSeries ? sineBySeries(a.rest) : sineNear(a.rest, near);
  const double cosine = cosineNear(near);
  const bool crossed = (a.quarters & 1) != 0;
  const double s = crossed ? cosine : sine, c = crossed ? sine : cosine;
  return {a.quarters & 2 ? -s : s, (a.quarters + 1) & 2 ? -c : c};
}

double tan(double x) {
  const auto [sine, cosine] = sincos(x);
  return sine / cosine;
}

}  // namespace carom::elementary
