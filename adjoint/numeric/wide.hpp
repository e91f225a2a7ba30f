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
struct Wide {
  static constexpr bool kPlainProducts = true;
  double high = 0, low = 0;

  Wide() = default;
  Wide(double v) : high(v) {}  // NOLINT: every double is one
  Wide(const elementary::TwoParts& p) : high(p.high), low(p.low) {}  // NOLINT: the same number
  explicit operator double() const { return high; }

  friend Wide operator-(const Wide& a) { return elementary::TwoParts{-a.high, -a.low}; }
  friend Wide operator+(const Wide& a) { return a; }
  friend Wide operator+(const Wide& a, const Wide& b) {
    const elementary::TwoParts s = elementary::sumOf(a.high, b.high), t = elementary::sumOf(a.low, b.low);
    const elementary::TwoParts first = elementary::sumOfOrdered(s.high, s.low + t.high);
    return elementary::sumOfOrdered(first.high, first.low + t.low);
  }
  friend Wide operator-(const Wide& a, const Wide& b) { return a + -b; }
  friend Wide operator*(const Wide& a, const Wide& b) {
    const elementary::TwoParts p = elementary::productOf(a.high, b.high);
    return elementary::sumOfOrdered(p.high, p.low + (a.high * b.low + a.low * b.high));
  }
  friend Wide operator/(const Wide& a, const Wide& b) {
    const double first = a.high / b.high;
    const Wide rest = a - b * first;
    const double second = rest.high / b.high, third = (rest - b * second).high / b.high;
    return Wide(elementary::sumOfOrdered(first, second)) + third;
  }
  Wide& operator+=(const Wide& o) { return *this = *this + o; }
  Wide& operator-=(const Wide& o) { return *this = *this - o; }
  Wide& operator*=(const Wide& o) { return *this = *this * o; }
  Wide& operator/=(const Wide& o) { return *this = *this / o; }

  friend auto operator<=>(const Wide&, const Wide&) = default;  // by the high parts, then by the low ones

  friend bool isfinite(const Wide& a) { return std::isfinite(a.high); }
  friend bool isinf(const Wide& a) { return std::isinf(a.high); }
  friend bool isnan(const Wide& a) { return std::isnan(a.high); }
  friend Wide abs(const Wide& a) { return a.high < 0 ? -a : a; }
  friend Wide sqrt(const Wide& a) {
    const double root = std::sqrt(a.high);
    if (!(root > 0)) return root;
    return Wide(root) + (a - Wide(elementary::productOf(root, root))).high / (2 * root);
  }
};

inline Wide valueOf(const Wide& x) { return x; }
/// The number as a double.
inline double rounded(double x) { return x; }
inline double rounded(const Wide& x) { return x.high; }

}  // namespace carom::adjoint_detail

namespace std {
template <>
struct numeric_limits<carom::adjoint_detail::Wide> : numeric_limits<double> {
  static carom::adjoint_detail::Wide epsilon() { return 0x1p-102; }
  static constexpr int digits10 = 30;
};
}  // namespace std

namespace Eigen {
template <>
struct NumTraits<carom::adjoint_detail::Wide> : GenericNumTraits<carom::adjoint_detail::Wide> {
  using Real = carom::adjoint_detail::Wide;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = double;
  static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }
  static Real dummy_precision() { return 1e-28; }
  static int digits10() { return std::numeric_limits<Real>::digits10; }
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 2, AddCost = 20, MulCost = 24 };
};
template <class Op>
struct ScalarBinaryOpTraits<carom::adjoint_detail::Wide, double, Op> {
  using ReturnType = carom::adjoint_detail::Wide;
};
template <class Op>
struct ScalarBinaryOpTraits<double, carom::adjoint_detail::Wide, Op> {
  using ReturnType = carom::adjoint_detail::Wide;
};
}  // namespace Eigen
