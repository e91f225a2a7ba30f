// SPDX-License-Identifier: MIT
// Where the numbers of worlds come from: Philox, Sobol's points, the normal distribution.
#include <gtest/gtest.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <set>

#include "explore/numbers/normal_quantile.hpp"
#include "explore/numbers/philox.hpp"
#include "explore/numbers/random_orientation.hpp"
#include "explore/numbers/sobol.hpp"
#include "tests/support/scaled.h"

namespace carom::explore_detail {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Random123 1.14.0, tests/kat_vectors, "philox4x32 10".
TEST(Philox, GivesTheKnownAnswersOfRandom123) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, NumbersLieStrictlyBetween0And1AndDiffer) {
  std::set<double> seen;
  for (std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32})
    for (std::uint64_t world : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32, std::uint64_t{1} << 62})
      for (std::uint32_t number = 0; number < 50; ++number) {
        const double u = randomNumber(seed, world, number);
        EXPECT_TRUE(u > 0 && u < 1);
        seen.insert(u);
      }
  EXPECT_EQ(seen.size(), 600u);
}

// scipy.stats.qmc.Sobol(64, scramble=False, bits=30) of SciPy 1.17.1 after fast_forward(world + 1), times 2^30.
TEST(Sobol, GivesThePointsOfSciPy) {
  struct Known {
    std::uint64_t world;
    std::uint32_t coordinates[7];
  };
  const int dimensions[7] = {0, 1, 2, 5, 17, 40, 63};
  const Known known[] = {{0, {536870912, 536870912, 536870912, 536870912, 536870912, 536870912, 536870912}},
                         {1, {805306368, 268435456, 268435456, 805306368, 268435456, 268435456, 805306368}},
                         {2, {268435456, 805306368, 805306368, 268435456, 805306368, 805306368, 268435456}},
                         {6, {134217728, 671088640, 402653184, 402653184, 134217728, 134217728, 402653184}},
                         {999, {235929600, 103809024, 556793856, 974127104, 370147328, 980418560, 479199232}},
                         {123456, {565321728, 733093888, 866787328, 755113984, 935927808, 315629568, 485482496}}};
  const SobolPoints points(64, 0);
  for (const Known& row : known)
    for (int k = 0; k < 7; ++k)
      EXPECT_EQ(points.coordinate(row.world, dimensions[k]), row.coordinates[k] * 0x1p-30)
          << row.world << " " << dimensions[k];
}

// Of 2^k points with their corner each of 2^k intervals has one, in every coordinate, shifted or not.
TEST(Sobol, EveryCoordinateIsStratified) {
  for (const std::uint64_t seed : {0, 7}) {
    const SobolPoints points(kSobolDimensions, seed);
    for (int d = 0; d < kSobolDimensions; ++d) {
      std::set<int> cells;
      for (std::uint64_t world = 127; world < 255; ++world) {  // points 128 to 255
        const double u = points.coordinate(world, d);
        EXPECT_TRUE(u > 0 && u < 1);
        cells.insert(static_cast<int>(u * 128));
      }
      EXPECT_EQ(cells.size(), 128u) << d;
    }
  }
  EXPECT_GT(SobolPoints(1, 0).coordinate(kSobolWorlds - 1, 0), 0);
}

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>>;

/// By how much a quantile is off, relative to itself, to first order: the probability in 50 digits.
double quantileError(double p, double z) {
  using boost::multiprecision::exp, boost::multiprecision::sqrt;
  const Wide x = z, below = boost::math::erfc(Wide(-x / sqrt(Wide(2)))) / 2;
  const Wide density = exp(Wide(-x * x / 2)) / sqrt(2 * boost::math::constants::pi<Wide>());
  return static_cast<double>((below - Wide(p)) / density / x);
}

TEST(NormalQuantile, IsExactBeside50Digits) {
  std::vector<double> probabilities = {0x1p-53,   1 - 0x1p-53, 1e-300, 1e-100, 1e-20, 0.075,
                                       0.0749999, 0.925,       0.3,    0.4999, 0.7};
  for (int k = 0; k < test::scaled(60); ++k) probabilities.push_back(randomNumber(5, static_cast<std::uint64_t>(k), 0));
  double worst = 0;
  for (const double p : probabilities) {
    const double error = std::abs(quantileError(p, normalQuantile(p)));
    worst = std::max(worst, error);
    EXPECT_TRUE(error <= 2e-15) << p << " " << error;
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_EQ(normalQuantile(0.5), 0);
  EXPECT_EQ(normalQuantile(0.25), -normalQuantile(0.75));
  EXPECT_EQ(normalQuantile(0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(normalQuantile(1), std::numeric_limits<double>::infinity());
}

TEST(NormalProbability, IsThatOfTheQuantile) {
  for (double z = -38; z < 8; z += 0.37) {
    const double p = normalProbability(z);
    const double exact = static_cast<double>(boost::math::erfc(Wide(-Wide(z) / sqrt(Wide(2)))) / 2);
    EXPECT_TRUE(std::abs(p - exact) <= 2e-15 * std::max(1.0, z * z) * exact) << z << " " << p << " " << exact;
  }
  EXPECT_EQ(normalProbability(0), 0.5);
  EXPECT_EQ(normalProbability(-40), 0);
  EXPECT_EQ(normalProbability(-std::numeric_limits<double>::infinity()), 0);
  EXPECT_EQ(normalProbability(std::numeric_limits<double>::infinity()), 1);
}

// Haar measure: R_ij has mean 0 and mean square 1/3; R e_z is uniform on the sphere, so that its z is uniform.
TEST(RandomOrientation, IsUniform) {
  const int count = test::scaled(20000);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), squares = sum;
  std::array<double, 10> cells{};
  for (int k = 0; k < count; ++k) {
    const auto world = static_cast<std::uint64_t>(k);
    const Quat q = orientationOf(randomNumber(1, world, 0), randomNumber(1, world, 1), randomNumber(1, world, 2));
    EXPECT_TRUE(std::abs(q.norm() - 1) <= 1e-15 && q.w() >= 0);
    const Mat3 R = q.toRotationMatrix();
    sum += R, squares += R.cwiseProduct(R);
    ++cells[std::min(9, static_cast<int>((R(2, 2) + 1) * 5))];
  }
  const double error = 4.5 / std::sqrt(3.0 * count);
  EXPECT_LE((sum / count).cwiseAbs().maxCoeff(), error);
  EXPECT_LE((squares / count - Eigen::Matrix3d::Constant(1.0 / 3)).cwiseAbs().maxCoeff(),
            4.5 * std::sqrt(4.0 / 45 / count));
  double chi = 0;
  for (const double cell : cells) chi += (cell - count / 10.0) * (cell - count / 10.0) / (count / 10.0);
  EXPECT_LE(chi, 33.7);  // 1 in 10 000, with 9 degrees of freedom
}

}  // namespace
}  // namespace carom::explore_detail
