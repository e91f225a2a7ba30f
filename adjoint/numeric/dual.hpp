// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <type_traits>

#include "adjoint/numeric/elementary.hpp"
#include "adjoint/numeric/plain_products.hpp"

// Internal to the libraries: not installed, and no public header includes it.

namespace carom::adjoint_detail {

/// A number with its rates along N directions. Arithmetic carries the rates along exactly; comparisons see the value
/// alone, so that a computation with duals takes the branches that the same computation with doubles takes. T is what
/// values and rates are: double, DoubleDouble, or a Dual, for second derivatives.
template <int N, class T = double>
struct Dual {
  static constexpr bool kPlainProducts = true;
  static constexpr int kDirections = N;
  T value = 0;
  std::array<T, N> rate{};

  Dual() = default;
  template <class U>
    requires std::is_convertible_v<U, T>
  Dual(const U& v) : value(v) {}  // NOLINT: a constant is a number
    /// The same with values and rates of another kind. (A number that T can hold is a constant.)
    template <class U>
      requires(!std::is_convertible_v<Dual<N, U>, T>)
    explicit Dual(const Dual<N, U>& o) : value(static_cast<T>(o.value)) {
      for (std::size_t i = 0; i < N; ++i) rate[i] = static_cast<T>(o.rate[i]);
    }

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
  Dual chain(const T& f, const T& slope) const {
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
    const T over = 1 / b.value;
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

  friend auto operator<=>(const Dual& a, const Dual& b) { return a.value <=> b.value; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }

  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const T root = sqrt(a.value);
    return a.chain(root, 0.5 / root);
  }
  friend Dual abs(const Dual& a) { return a.value < 0 ? -a : a; }
  friend Dual sin(const Dual& a) {
    if constexpr (std::is_same_v<T, double>) {
      const auto [sine, cosine] = elementary::sincos(a.value);
      return a.chain(sine, cosine);
    } else {
      return a.chain(sin(a.value), cos(a.value));
    }
  }
  friend Dual cos(const Dual& a) {
    if constexpr (std::is_same_v<T, double>) {
      const auto [sine, cosine] = elementary::sincos(a.value);
      return a.chain(cosine, -sine);
    } else {
      return a.chain(cos(a.value), -sin(a.value));
    }
  }
  friend Dual exp(const Dual& a) {
    using elementary::exp;
    const T power = exp(a.value);
    return a.chain(power, power);
  }
};

template <int N, class T>
bool isZero(const Dual<N, T>& x) {
  const auto vanishes = [](const T& part) {
    if constexpr (requires { part.rate; }) {
      return isZero(part);
    } else {
      return part == 0;
    }
  };
  return vanishes(x.value) && std::all_of(x.rate.begin(), x.rate.end(), vanishes);
}

/// How often a number can be differentiated: 0 for a double, one more for each Dual around it.
template <class S>
inline constexpr int kOrderOf = 0;
template <int N, class T>
inline constexpr int kOrderOf<Dual<N, T>> = 1 + kOrderOf<T>;

/// The number without any rates.
inline double primalOf(double x) { return x; }
template <int N, class T>
double primalOf(const Dual<N, T>& x) {
  return primalOf(x.value);
}
template <class Matrix>
auto primalsOf(const Matrix& m) {
  return m.unaryExpr([](const auto& x) { return primalOf(x); }).eval();
}

/// What the values of a number are: T of Dual<N, T>, else the number itself.
template <class S>
struct ValueOf {
  using Type = S;
};
template <int N, class T>
struct ValueOf<Dual<N, T>> {
  using Type = T;
};
template <class S>
using Value = typename ValueOf<S>::Type;

inline double valueOf(double x) { return x; }
template <int N, class T>
T valueOf(const Dual<N, T>& x) {
  return x.value;
}

/// Along direction i; a constant has the rate 0.
inline double rateOf(double, std::size_t) { return 0; }
template <int N, class T>
T rateOf(const Dual<N, T>& x, std::size_t i) {
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
template <class S>
using MatrixOf = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <class S>
using VectorOf = Eigen::Matrix<S, Eigen::Dynamic, 1>;

}  // namespace carom::adjoint_detail

namespace Eigen {
template <int N, class T>
struct NumTraits<carom::adjoint_detail::Dual<N, T>> : GenericNumTraits<double> {
  using Real = carom::adjoint_detail::Dual<N, T>;
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
template <int N, class T, class Op>
struct ScalarBinaryOpTraits<carom::adjoint_detail::Dual<N, T>, double, Op> {
  using ReturnType = carom::adjoint_detail::Dual<N, T>;
};
template <int N, class T, class Op>
struct ScalarBinaryOpTraits<double, carom::adjoint_detail::Dual<N, T>, Op> {
  using ReturnType = carom::adjoint_detail::Dual<N, T>;
};
}  // namespace Eigen
