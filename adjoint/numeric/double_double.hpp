// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <limits>

#include "adjoint/numeric/elementary/two_parts.hpp"
#include "adjoint/numeric/plain_products.hpp"

// Internal to the libraries: not installed, and no public header includes it.

namespace carom::adjoint_detail {

/// A number of 32 digits, the sum of two doubles, for impacts of bodies whose masses differ too much for 16. Sums,
/// products, quotients and roots have errors of about 1e-31 of their operands (Y. Hida, X. S. Li, D. H. Bailey,
/// "Algorithms for quad-double precision floating point arithmetic", 2001). Below 1e300, and above 1e-290, where parts
/// underflow.
struct DoubleDouble {
  static constexpr bool kPlainProducts = true;
  double high = 0, low = 0;

  DoubleDouble() = default;
  DoubleDouble(double v) : high(v) {}  // NOLINT: every double is one
  DoubleDouble(const elementary::TwoParts& p) : high(p.high), low(p.low) {}  // NOLINT: the same number
  explicit operator double() const { return high; }

  friend DoubleDouble operator-(const DoubleDouble& a) { return elementary::TwoParts{-a.high, -a.low}; }
  friend DoubleDouble operator+(const DoubleDouble& a) { return a; }
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const elementary::TwoParts s = elementary::sumOf(a.high, b.high), t = elementary::sumOf(a.low, b.low);
    const elementary::TwoParts first = elementary::sumOfOrdered(s.high, s.low + t.high);
    return elementary::sumOfOrdered(first.high, first.low + t.low);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const elementary::TwoParts p = elementary::productOf(a.high, b.high);
    return elementary::sumOfOrdered(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double first = a.high / b.high;
    const DoubleDouble rest = a - b * first;
    const double second = rest.high / b.high, third = (rest - b * second).high / b.high;
    return DoubleDouble(elementary::sumOfOrdered(first, second)) + third;
  }
  DoubleDouble& operator+=(const DoubleDouble& o) { return *this = *this + o; }
  DoubleDouble& operator-=(const DoubleDouble& o) { return *this = *this - o; }
  DoubleDouble& operator*=(const DoubleDouble& o) { return *this = *this * o; }
  DoubleDouble& operator/=(const DoubleDouble& o) { return *this = *this / o; }

  friend auto operator<=>(const DoubleDouble&, const DoubleDouble&) = default;  // by the high parts, then by the low ones

  friend bool isfinite(const DoubleDouble& a) { return std::isfinite(a.high); }
  friend bool isinf(const DoubleDouble& a) { return std::isinf(a.high); }
  friend bool isnan(const DoubleDouble& a) { return std::isnan(a.high); }
  friend DoubleDouble abs(const DoubleDouble& a) { return a.high < 0 ? -a : a; }
  friend DoubleDouble sqrt(const DoubleDouble& a) {
    const double root = std::sqrt(a.high);
    if (!(root > 0)) return root;
    return DoubleDouble(root) + (a - DoubleDouble(elementary::productOf(root, root))).high / (2 * root);
  }
};

inline DoubleDouble valueOf(const DoubleDouble& x) { return x; }
/// The number as a double.
inline double rounded(double x) { return x; }
inline double rounded(const DoubleDouble& x) { return x.high; }

}  // namespace carom::adjoint_detail

namespace std {
template <>
struct numeric_limits<carom::adjoint_detail::DoubleDouble> : numeric_limits<double> {
  static carom::adjoint_detail::DoubleDouble epsilon() { return 0x1p-102; }
  static constexpr int digits10 = 30;
};
}  // namespace std

namespace Eigen {
template <>
struct NumTraits<carom::adjoint_detail::DoubleDouble> : GenericNumTraits<carom::adjoint_detail::DoubleDouble> {
  using Real = carom::adjoint_detail::DoubleDouble;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static Real dummy_precision() { return 1e-28; }
  static int digits10() { return std::numeric_limits<Real>::digits10; }
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 2, AddCost = 20, MulCost = 24 };
};
template <class Op>
struct ScalarBinaryOpTraits<carom::adjoint_detail::DoubleDouble, double, Op> {
  using ReturnType = carom::adjoint_detail::DoubleDouble;
};
template <class Op>
struct ScalarBinaryOpTraits<double, carom::adjoint_detail::DoubleDouble, Op> {
  using ReturnType = carom::adjoint_detail::DoubleDouble;
};
}  // namespace Eigen
