// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"
#include "ode_bridge/gaps/rows.hpp"

/// Where a function F of the angle around a rim is least: zeros of its slope G where G rises, of which there are two at
/// most, bracketed by samples of G and G' and refined by Newton's method inside the bracket.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

/// An angle around a rim.
template <class S>
struct Turn {
  S c, s;  // cos and sin of theta
  explicit Turn(const S& theta) {
    using elementary::cos, elementary::sin;
    c = cos(theta), s = sin(theta);
  }
  Turn() = default;
};

template <class S>
struct Slope {
  S G, second;  // G and dG/dtheta
};

/// The zero of G in (low, high), G(low) < 0 < G(high).
template <class Curve>
double zero(const Curve& curve, double low, double high) {
  double theta = 0.5 * (low + high);
  for (int i = 0; i < 100; ++i) {
    const Slope<double> at = curve.slope(Turn<double>(theta));
    if (at.G == 0) break;
    (at.G < 0 ? low : high) = theta;
    double next = theta - at.G / at.second;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - theta) <= 1e-16 * std::max(1.0, std::abs(theta))) break;
    theta = next;
  }
  return theta;
}

/// Where between low and high, at both of which G has one sign, G is extreme; `end` is that of G' at low. Stops early
/// where G has the other sign.
template <class Curve>
double extreme(const Curve& curve, double low, double high, double sign, double end) {
  for (int i = 0; i < 24; ++i) {
    const double theta = 0.5 * (low + high);
    const Slope<double> at = curve.slope(Turn<double>(theta));
    if (!(at.G * sign > 0)) return theta;
    (at.second * end > 0 ? low : high) = theta;
  }
  return 0.5 * (low + high);
}

inline constexpr int kSamples = 32;

inline double angle(int i) { return 2 * std::numbers::pi / kSamples * i; }

inline const std::array<Turn<double>, kSamples>& turns() {
  static const std::array<Turn<double>, kSamples> all = [] {
    std::array<Turn<double>, kSamples> made;
    for (int i = 0; i < kSamples; ++i) made[static_cast<std::size_t>(i)] = Turn<double>(angle(i));
    return made;
  }();
  return all;
}

struct Minima {
  int count = 0;
  std::array<double, 2> theta{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  void add(double at) {
    if (count < 2) theta[static_cast<std::size_t>(count++)] = at;
  }
};

/// Minima of F by theta: at most two. `curve.slope(Turn)` is the Slope there.
template <class Curve>
Minima minimaOf(const Curve& curve) {
  const auto& sample = turns();
  Minima found;
  const Slope<double> start = curve.slope(sample[0]);
  Slope<double> left = start;
  for (int i = 0; i < kSamples; ++i) {
    const Slope<double> right = i + 1 < kSamples ? curve.slope(sample[static_cast<std::size_t>(i + 1)]) : start;
    const double low = angle(i), high = angle(i + 1);
    if (left.G < 0 && right.G >= 0) {
      found.add(right.G > 0 ? zero(curve, low, high) : high);
    } else if (left.G > 0 && right.G > 0 && left.second < 0 && right.second > 0) {
      const double dip = extreme(curve, low, high, 1, -1);
      if (curve.slope(Turn<double>(dip)).G < 0) found.add(zero(curve, dip, high));
    } else if (left.G < 0 && right.G < 0 && left.second > 0 && right.second < 0) {
      const double bump = extreme(curve, low, high, -1, 1);
      if (curve.slope(Turn<double>(bump)).G > 0) found.add(zero(curve, low, bump));
    }
    left = right;
  }
  return found;
}

}  // namespace carom::gaps
