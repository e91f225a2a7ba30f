// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "adjoint/numeric/dual.hpp"

namespace carom::adjoint_detail {

/// Integral of exp(-rate y) over [0, xi]: (1 - exp(-rate xi))/rate, smooth where the rate is 0.
template <class S>
S decayIntegral(const S& rate, const S& xi) {
  using elementary::exp;
  const S x = rate * xi;
  if (std::abs(primalOf(x)) < 0.5) {
    S sum = 1;
    for (int k = 15; k >= 1; --k) sum = 1.0 - x * sum / (k + 1.0);
    return xi * sum;
  }
  return (1.0 - exp(-x)) / rate;
}

/// Most moments that are asked for.
inline constexpr int kMoments = 34;
template <class S>
using Moments = std::array<S, kMoments>;

/// The first `count` integrals of y^n exp(-rate y)/n! over [0, xi], rate >= 0: by their recurrence in the direction in
/// which all that is added is positive.
template <class S>
Moments<S> decayMoments(const S& rate, const S& xi, int count) {
  using elementary::exp;
  const S x = rate * xi, decay = exp(-x);
  Moments<S> moments;
  if (primalOf(x) > 40) {
    S power = decay;  // xi^n exp(-x)/n!
    for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
      moments[n] = ((n == 0 ? S(1.0) : moments[n - 1]) - power) / rate;
      power *= xi / (static_cast<double>(n) + 1);
    }
    return moments;
  }
  Moments<S> power;  // xi^n exp(-x)/n!
  power[0] = decay;
  const auto last = static_cast<std::size_t>(count - 1);
  for (std::size_t n = 1; n <= last; ++n) power[n] = power[n - 1] * (xi / static_cast<double>(n));
  S term = power[last] * (xi / static_cast<double>(count)), sum = term;
  for (int k = count + 1; k < 200; ++k) {
    term *= x / static_cast<double>(k);
    sum += term;
    if (k > count + 3 && k > primalOf(x) + 6 && primalOf(term) <= 1e-20 * primalOf(sum)) break;
  }
  moments[last] = sum;
  for (std::size_t n = last; n > 0; --n) moments[n - 1] = rate * moments[n] + power[n];
  return moments;
}

}  // namespace carom::adjoint_detail
