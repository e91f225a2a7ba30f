// SPDX-License-Identifier: MIT
#include "adjoint/contact/slip_clock.hpp"

#include <algorithm>

#include "adjoint/contact/decay_integrals.hpp"

namespace carom::adjoint_detail {

double SlipClock::timeAt(double xi) const {
  return P * decayIntegral(c - a, xi) + Q * decayIntegral(c + a, xi);
}

double SlipClock::speedAt(double xi) const {
  return P * elementary::exp((a - c) * xi) + Q * elementary::exp(-(c + a) * xi);
}

double SlipClock::tiltAt(double xi) const {
  return P > 0 ? std::sqrt(Q / P) * elementary::exp(-a * xi) : 1;
}

// By Newton on the logarithm of what is left of the time, p exp(-alpha xi) + q exp(-beta xi): its slope is between
// -beta and -alpha, and it is convex, so that the steps from the left never pass the root.
double SlipClock::xiBeforeEnd(double remaining) const {
  const double alpha = c - a, beta = c + a, p = P > 0 ? P / alpha : 0, q = Q / beta;
  double xi = 0;
  for (int k = 0; k < 60; ++k) {
    const double first = p > 0 ? p * elementary::exp(-alpha * xi) : 0, second = q * elementary::exp(-beta * xi);
    const double left = first + second;
    const double step = elementary::log(left / remaining) * left / (alpha * first + beta * second);
    if (!std::isfinite(step)) break;
    xi = std::max(0.0, xi + step);
    if (std::abs(step) <= 1e-15 * xi) break;
  }
  return xi;
}

double SlipClock::xiAt(double t) const {
  if (!(t > 0)) return 0;
  if (c > a || P == 0) {
    const double end = (P > 0 ? P / (c - a) : 0) + Q / (c + a), remaining = end - t;
    if (remaining < 0.5 * end) return xiBeforeEnd(remaining);
  }
  double low = 0, high = t / (P + Q);
  for (int k = 0; k < 200 && timeAt(high) < t; ++k) low = high, high *= 2;
  double xi = low;
  for (int k = 0; k < 200; ++k) {
    const double time = timeAt(xi), speed = speedAt(xi);
    (time < t ? low : high) = xi;
    // Where time grows by its own size it is its logarithm that is nearly straight.
    double next = xi - (time > t ? elementary::log(time / t) * time : time - t) / speed;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double step = std::abs(next - xi);
    xi = next;
    if (step <= 1e-15 * xi) break;
  }
  return xi;
}

}  // namespace carom::adjoint_detail
