// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "adjoint/elementary.h"

// Internal to the libraries: not installed, and no public header includes it.

namespace carom::detail {

/// A number with its rates along N directions. Arithmetic carries the rates along exactly; comparisons see the value
/// alone, so that a computation with duals takes the branches that the same computation with doubles takes.
template <int N>
struct Dual {
  static constexpr int kDirections = N;
  double value = 0;
  std::array<double, N> rate{};

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: a constant is a number

  Dual& operator+=(const Dual& o) {
    value += o.value;
    for (std::size_t i = 0; i < N; ++i) rate[i] += o.rate[i];
    return *this;
  }
  Dual& operator-=(const Dual& o) {
    value -= o.value;
    for (std::size_t i = 0; i < N; ++i) rate[i] -= o.rate[i];
    return *this;
  }
  Dual& operator*=(const Dual& o) { return *this = *this * o; }
  Dual& operator/=(const Dual& o) { return *this = *this / o; }
  Dual operator-() const { return chain(-value, -1); }
  Dual operator+() const { return *this; }

  /// f(value) with its slope f'(value).
  Dual chain(double f, double slope) const {
    Dual r;
    r.value = f;
    for (std::size_t i = 0; i < N; ++i) r.rate[i] = slope * rate[i];
    return r;
  }

  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value + b.value;
    for (std::size_t i = 0; i < N; ++i) r.rate[i] = a.rate[i] + b.rate[i];
    return r;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value - b.value;
    for (std::size_t i = 0; i < N; ++i) r.rate[i] = a.rate[i] - b.rate[i];
    return r;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value * b.value;
    for (std::size_t i = 0; i < N; ++i) r.rate[i] = a.rate[i] * b.value + a.value * b.rate[i];
    return r;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual r;
    r.value = a.value / b.value;
    const double over = 1 / b.value;
    for (std::size_t i = 0; i < N; ++i) r.rate[i] = (a.rate[i] - r.value * b.rate[i]) * over;
    return r;
  }
  friend Dual operator+(Dual a, double b) { return a.value += b, a; }
  friend Dual operator+(double a, Dual b) { return b.value += a, b; }
  friend Dual operator-(Dual a, double b) { return a.value -= b, a; }
  friend Dual operator-(double a, const Dual& b) { return b.chain(a - b.value, -1); }
  friend Dual operator*(const Dual& a, double b) { return a.chain(a.value * b, b); }
  friend Dual operator*(double a, const Dual& b) { return b.chain(a * b.value, a); }
  friend Dual operator/(const Dual& a, double b) { return a.chain(a.value / b, 1 / b); }

  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  friend bool operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
  friend Dual abs(const Dual& a) { return a.value < 0 ? -a : a; }
  friend Dual sin(const Dual& a) {
    const auto [sine, cosine] = elementary::sincos(a.value);
    return a.chain(sine, cosine);
  }
  friend Dual cos(const Dual& a) {
    const auto [sine, cosine] = elementary::sincos(a.value);
    return a.chain(cosine, -sine);
  }
};

inline double valueOf(double x) { return x; }
template <int N>
double valueOf(const Dual<N>& x) {
  return x.value;
}

/// Along direction i; a constant has the rate 0.
inline double rateOf(double, std::size_t) { return 0; }
template <int N>
double rateOf(const Dual<N>& x, std::size_t i) {
  return x.rate[i];
}

/// Matrix of values, and of the rates along direction i.
template <class Matrix>
auto valuesOf(const Matrix& m) {
  return m.unaryExpr([](const auto& x) { return valueOf(x); }).eval();
}
template <class Matrix>
auto ratesOf(const Matrix& m, std::size_t i) {
  return m.unaryExpr([i](const auto& x) { return rateOf(x, i); }).eval();
}
/// The other way about: sets the rates along direction i.
template <class Matrix, class Rates>
void setRates(Matrix& m, const Rates& rates, std::size_t i) {
  for (Eigen::Index c = 0; c < m.cols(); ++c)
    for (Eigen::Index r = 0; r < m.rows(); ++r) m(r, c).rate[i] = rates(r, c);
}

template <class S>
using V2 = Eigen::Matrix<S, 2, 1>;
template <class S>
using V3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using M3 = Eigen::Matrix<S, 3, 3>;

/// [a]x and its adjoint, as in types.h.
template <class S>
M3<S> skewOf(const V3<S>& a) {
  M3<S> m;
  m << S(0), -a.z(), a.y(), a.z(), S(0), -a.x(), -a.y(), a.x(), S(0);
  return m;
}
template <class S>
V3<S> unskewOf(const M3<S>& m) {
  return {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
}

}  // namespace carom::detail

namespace Eigen {
template <int N>
struct NumTraits<carom::detail::Dual<N>> : GenericNumTraits<double> {
  using Real = carom::detail::Dual<N>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N + 1,
    AddCost = N + 1,
    MulCost = 3 * N
  };
};
template <int N, class Op>
struct ScalarBinaryOpTraits<carom::detail::Dual<N>, double, Op> {
  using ReturnType = carom::detail::Dual<N>;
};
template <int N, class Op>
struct ScalarBinaryOpTraits<double, carom::detail::Dual<N>, Op> {
  using ReturnType = carom::detail::Dual<N>;
};
}  // namespace Eigen
