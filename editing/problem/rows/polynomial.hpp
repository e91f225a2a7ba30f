// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <vector>

/// Roots of polynomials of low degree. Internal to editing/.
namespace carom::editing_detail {

/// c[0] + c[1] s + ... + c[N] s^N.
template <int N>
using Polynomial = std::array<double, N + 1>;

template <int N>
double valueAt(const Polynomial<N>& c, double s) {
  double value = c[N];
  for (std::size_t k = N; k-- > 0;) value = value * s + c[k];
  return value;
}

template <int N>
Polynomial<N - 1> derivativeOf(const Polynomial<N>& c) {
  Polynomial<N - 1> d;
  for (std::size_t k = 0; k < N; ++k) d[k] = static_cast<double>(k + 1) * c[k + 1];
  return d;
}

/// Real roots with a change of sign in [lo, hi], in increasing order: between the roots of the derivative a polynomial
/// is monotone, so that bisection cannot miss one.
template <int N>
std::vector<double> rootsIn(const Polynomial<N>& c, double lo, double hi) {
  std::vector<double> roots;
  if constexpr (N == 1) {
    const double s = -c[0] / c[1];
    if (s >= lo && s <= hi) roots.push_back(s);  // no root where c[1] is 0: the comparison fails
  } else {
    std::vector<double> ends = rootsIn<N - 1>(derivativeOf<N>(c), lo, hi);
    ends.insert(ends.begin(), lo);
    ends.push_back(hi);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      double a = ends[i], b = ends[i + 1];
      const double fa = valueAt<N>(c, a), fb = valueAt<N>(c, b);
      if (!((fa <= 0 && fb > 0) || (fa >= 0 && fb < 0))) continue;
      for (double middle = a + (b - a) / 2; middle > a && middle < b; middle = a + (b - a) / 2)
        ((valueAt<N>(c, middle) > 0) == (fb > 0) ? b : a) = middle;
      roots.push_back(b);
    }
  }
  return roots;
}

}  // namespace carom::editing_detail
