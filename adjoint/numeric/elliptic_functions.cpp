// SPDX-License-Identifier: MIT
#include "adjoint/numeric/elliptic_functions.hpp"

#include <cmath>

#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {

// Every step takes k to (1 - k')/(1 + k'), until k^2 is below the rounding and the functions are circular.
EllipticModulus::EllipticModulus(double m1) {
  double complement = std::sqrt(m1), k = std::sqrt(1 - m1);
  while (k > 3e-9 && count_ < steps_.size()) {
    k = (1 - complement) / (1 + complement);
    steps_[count_++] = {complement, k};
    shrinking_ *= 1 + k;
    complement = 2 * std::sqrt(complement) / (1 + complement);
  }
  K_ = 0.5 * M_PI * shrinking_;
}

// tan(phi_1 - phi) = k' tan(phi) and F(phi, k) = (1 + k1)/2 F(phi_1, k1). The angle is a vector and a number of turns:
// where k' and cos(phi) are both small, their ratio counts. phi_1 - phi is on the side of phi, so that the vector of
// phi_1 changes sides only by completing a turn.
double EllipticModulus::incompleteF(double x, double y) const {
  double turns = 0, half = 1;
  for (std::size_t i = 0; i < count_; ++i) {
    const double across = steps_[i].complement * y;  // (x, across): at phi_1 - phi
    const double next_x = x * x - y * across, next_y = y * x + x * across;
    const double size = std::sqrt(next_x * next_x + next_y * next_y);
    turns *= 2;
    if (std::signbit(next_y) != std::signbit(y)) turns += std::signbit(y) ? -1 : 1;
    x = next_x / size, y = next_y / size;
    half *= 0.5;
  }
  return half * shrinking_ * (elementary::atan2(y, x) + 2 * M_PI * turns);
}

EllipticModulus::Functions EllipticModulus::at(double u) const {
  u /= shrinking_;
  auto [sn, cn] = elementary::sincos(u);
  double dn = 1;
  for (std::size_t i = count_; i-- > 0;) {
    const double k1 = steps_[i].k1, square = k1 * sn * sn, below = 1 / (1 + square);
    cn *= dn * below;
    sn *= (1 + k1) * below;
    dn = (1 - square) * below;
  }
  return {sn, cn, dn};
}

}  // namespace carom::adjoint_detail
