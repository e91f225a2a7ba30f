// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "adjoint/numeric/elementary/constants.hpp"
#include "adjoint/numeric/elementary/two_parts.hpp"

namespace carom::elementary {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// (high + low) 2^scale; 1 <= high < 2, |low| < 2^-6.
struct Exponential {
  double high, low;
  std::int64_t scale;
};

/// e^(x + small), |x| < 1000, |small| < 1e-9; error below 2^-59 of it.
inline Exponential exponentialOf(double x, double small) {
  const Nearest n(x * kStepsOfExpInOne);
  const double r = (x - n.value * kStepOfExp[0]) - (n.value * kStepOfExp[1] - small);
  const double grown = r + r * r * polynomial(r, {1. / 2, 1. / 6, 1. / 24, 1. / 120, 1. / 720});  // e^r - 1
  const double* power = kPowersOfTwo[n.integer & 63];
  return {power[0], power[1] + power[0] * grown, n.integer >> 6};
}

/// The double next to it, infinity or a denormalised number included.
double rounded(const Exponential& e);

}  // namespace carom::elementary
