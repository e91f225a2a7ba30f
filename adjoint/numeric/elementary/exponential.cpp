// SPDX-License-Identifier: MIT
#include "adjoint/numeric/elementary/exponential.hpp"

#include <cmath>

#include "adjoint/numeric/elementary.hpp"

namespace carom::elementary {
namespace {

constexpr double kNearlyLargest = 708;  // up to there e^x and e^-x are normal numbers
constexpr double kOneSided = 22;        // from there on e^-x is below a rounding of e^x

}  // namespace

double rounded(const Exponential& e) {
  if (e.scale >= 1024) return e.scale > 1030 ? kInfinity : (e.high + e.low) * 0x1p1023 * twoTo(e.scale - 1023);
  if (e.scale >= -1021) return (e.high + e.low) * twoTo(e.scale);
  if (e.scale < -1080) return 0;
  // Denormalised numbers are equally spaced, as are the doubles from `floor` to twice of it: the sum with it is rounded
  // where the result will be.
  const double floor = e.scale < -1022 ? twoTo(-1022 - e.scale) : 1;
  if (e.scale >= -1022 && e.high + e.low >= 1) return (e.high + e.low) * twoTo(-1022);
  const TwoParts sum = sumOfOrdered(floor, e.high);
  const double total = sum.high + (sum.low + e.low);
  return (total - floor) * twoTo(-1022) * (1 / floor);
}

double exp(double x) {
  if (std::abs(x) < kNearlyLargest) {
    const Exponential e = exponentialOf(x, 0);
    return (e.high + e.low) * twoTo(e.scale);
  }
  if (std::isnan(x)) return x;
  if (x > 710) return kInfinity;
  if (x < -746) return 0;
  return rounded(exponentialOf(x, 0));
}

double sinh(double x) {
  const double size = std::abs(x), z = x * x;
  if (size < 0.25) {
    return x + x * z * polynomial(z, {1. / 6, 1. / 120, 1. / 5040, 1. / 362880, 1. / 39916800, 1. / 6227020800});
  }
  if (!(size < 711)) return x * kInfinity;
  Exponential up = exponentialOf(size, 0);
  --up.scale;
  if (size > kOneSided) return std::copysign(rounded(up), x);
  const Exponential down = exponentialOf(-size, 0);
  const double grown = twoTo(up.scale), shrunk = twoTo(down.scale - 1);
  const TwoParts sum = sumOfOrdered(up.high * grown, -down.high * shrunk);
  return std::copysign(sum.high + (sum.low + (up.low * grown - down.low * shrunk)), x);
}

double cosh(double x) {
  const double size = std::abs(x);
  if (!(size < 711)) return size * kInfinity;
  Exponential up = exponentialOf(size, 0);
  --up.scale;
  if (size > kOneSided) return rounded(up);
  const Exponential down = exponentialOf(-size, 0);
  const double grown = twoTo(up.scale), shrunk = twoTo(down.scale - 1);
  const TwoParts sum = sumOf(up.high * grown, down.high * shrunk);
  return sum.high + (sum.low + (up.low * grown + down.low * shrunk));
}

}  // namespace carom::elementary
