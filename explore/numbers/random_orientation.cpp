// SPDX-License-Identifier: MIT
#include "explore/numbers/random_orientation.hpp"

#include <cmath>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"

namespace carom::explore_detail {

Quat orientationOf(double u, double v, double w) {
  const auto [sine_v, cosine_v] = elementary::sincos(2 * std::numbers::pi * v);
  const auto [sine_w, cosine_w] = elementary::sincos(2 * std::numbers::pi * w);
  const double a = std::sqrt(1 - u), b = std::sqrt(u);
  const double sign = b * cosine_w < 0 ? -1 : 1;
  return Quat(sign * b * cosine_w, sign * a * sine_v, sign * a * cosine_v, sign * b * sine_w);
}

}  // namespace carom::explore_detail
