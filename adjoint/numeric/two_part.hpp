// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

/// A number as the sum of two doubles, `low` at most about a rounding of `high`: 32 digits instead of 16. Differences
/// of doubles have no error in it, products only below 1e-290, where their low part underflows (T. J. Dekker, "A
/// floating-point technique for extending the available precision", 1971; D. Knuth, TAOCP 2, 4.2.2).
struct TwoPart {
  double high = 0, low = 0;

  static TwoPart difference(double a, double b);
  static TwoPart product(double a, double b);
  TwoPart operator+(const TwoPart& other) const;
  TwoPart operator-(const TwoPart& other) const { return *this + TwoPart{-other.high, -other.low}; }
  TwoPart operator*(const TwoPart& other) const;  ///< error about 1e-31 of it
  double value() const { return high + low; }
};

/// (a - o) x (b - o), m^2; error about a rounding of it, plus 1e-31 |a - o| |b - o|: of a sliver as good as of any
/// other triangle, where a plain cross product would turn the normal of one 1e-6 as high as it is long by 1e-10.
Vec3 crossProduct(const Vec3& o, const Vec3& a, const Vec3& b);

/// (a - o) . ((b - o) x (c - o)), m^3: six times the signed volume of a tetrahedron; error about a rounding of it, plus
/// 1e-30 |a - o| |b - o| |c - o|, so that of a needle as of a plate the sign is that of the exact value.
double tripleProduct(const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace carom::adjoint_detail
