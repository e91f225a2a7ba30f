// SPDX-License-Identifier: MIT
// Products of differences to twice the digits, against a hundred digits.

#include "adjoint/numeric/two_part.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "adjoint/numeric/double_double.hpp"
#include "tests/support/compare.h"
#include "tests/support/exact/vector.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;
using Real = boost::multiprecision::cpp_bin_float_100;
using Exact = exact::Vec<Real>;

constexpr double kRounding = 2.3e-16;

void expectWithin(double found, const Real& exact, double share, const char* what) {
  const auto expected = static_cast<double>(exact);
  const double allowed = kRounding * std::abs(expected) + share;
  const auto error = static_cast<double>(Real(abs(Real(found) - exact)));
  EXPECT_TRUE(error <= allowed) << what << ": found " << found << ", expected " << expected << ", error " << error;
}

// Needles and plates of every thickness, any way round, near the origin and far from it.
TEST(TwoPart, ProductsOfThinTetrahedra) {
  Random random(61);
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE("seed 61, throw " + std::to_string(i));
    const double size = std::pow(10, random.in(-25, 8)), far = i % 2 ? std::pow(10, random.in(-3, 4)) : 0;
    const Vec3 o = size * far * random.unit(), along = random.vec(1), aside = random.vec(1), up = random.vec(1);
    const double width = std::pow(10, random.in(-12, 0)), height = std::pow(10, random.in(-12, 0));
    const Vec3 a = o + size * along, b = o + size * (random.in(-1, 1) * along + width * aside),
               c = o + size * (random.in(-1, 1) * along + width * random.in(-1, 1) * aside + height * up);
    const Exact u = Exact(a) - Exact(o), v = Exact(b) - Exact(o), w = Exact(c) - Exact(o), area = cross(u, v);

    const double lengths = (a - o).norm() * (b - o).norm();
    const Vec3 found = crossProduct(o, a, b);
    for (int k = 0; k < 3; ++k) expectWithin(found[k], area[k], 1e-31 * lengths, "area");
    expectWithin(tripleProduct(o, a, b, c), dot(u, cross(v, w)), 1e-30 * lengths * (c - o).norm(), "volume");
    if (HasFailure()) return;
  }
}

TEST(TwoPart, NothingIsLost) {
  const DoubleDouble third = DoubleDouble(1 / 3.) * DoubleDouble(1 / 3.), difference = DoubleDouble(1) - DoubleDouble(1e-20), sum = third + difference;
  EXPECT_EQ(Real(third.high) + Real(third.low), Real(1 / 3.) * Real(1 / 3.));
  expectEntries((sum - DoubleDouble(1) - third).high, -1e-20, 1e-31, "sum");
  expectEntries((difference * DoubleDouble(3) - DoubleDouble(3)).high, -3e-20, 1e-31, "product");
}

}  // namespace
}  // namespace carom
