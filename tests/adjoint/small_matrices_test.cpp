// SPDX-License-Identifier: MIT
// Sums and products of small matrices: the bits of Eigen's where it has one order, one order where it has two, and
// Eigen's own where a size is not fixed.

#include "adjoint/base/small_matrices.h"

#include <gtest/gtest.h>

#include <random>
#include <type_traits>

#include "adjoint/base/types.h"
#include "adjoint/numeric/dual.hpp"

namespace carom {
namespace {

using adjoint_detail::Dual;
using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;

class SmallMatrices : public testing::TestWithParam<unsigned> {
 protected:
  template <class Matrix>
  Matrix any() {
    Matrix out;
    for (int j = 0; j < out.cols(); ++j)
      for (int i = 0; i < out.rows(); ++i) out(i, j) = number_(random_);
    return out;
  }

  std::mt19937 random_{GetParam()};
  std::uniform_real_distribution<double> number_{-3, 3};
};

TEST_P(SmallMatrices, SumsAndMultiplesHaveTheBitsOfEigens) {
  const Mat3 odd = any<Mat3>(), other = any<Mat3>();  // a last entry without a second one
  EXPECT_EQ(Mat3(odd + other), Mat3(odd.operator+(other)));
  EXPECT_EQ(Mat3(odd - other), Mat3(odd.operator-(other)));
  EXPECT_EQ(Mat3(-odd), Mat3(odd.operator-()));
  EXPECT_EQ(Mat3(odd / 3), Mat3(odd.operator/(3.0)));
  const Mat6 a = any<Mat6>(), b = any<Mat6>();
  const Vec6 v = any<Vec6>();
  const double s = number_(random_);
  EXPECT_EQ(Mat6(a + b), Mat6(a.operator+(b)));
  EXPECT_EQ(Mat6(a - b), Mat6(a.operator-(b)));
  EXPECT_EQ(Mat6(-a), Mat6(a.operator-()));
  EXPECT_EQ(Mat6(a * s), Mat6(a.operator*(s)));
  EXPECT_EQ(Mat6(s * a), Mat6(a.operator*(s)));
  EXPECT_EQ(Mat6(a / s), Mat6(a.operator/(s)));
  EXPECT_EQ(Mat6(a.transpose() - b), Mat6(a.transpose().operator-(b)));
  EXPECT_EQ(Vec3(v.head<3>() + a.block<3, 1>(1, 2)), Vec3(v.head<3>().operator+(a.block<3, 1>(1, 2))));
  EXPECT_EQ(Vec3(v.cwiseAbs().tail<3>() * 2), Vec3(v.cwiseAbs().tail<3>().operator*(2.0)));
}

TEST_P(SmallMatrices, ProductsAreSumsInOrderWhereverTheyLie) {
  const Mat3 a = any<Mat3>(), b = any<Mat3>();
  Mat3 expected;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) expected(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  EXPECT_EQ(Mat3(a * b), expected);
  EXPECT_EQ(Mat3(b.transpose() * a.transpose()), Mat3(expected.transpose()));
  double memory[2 * 9 + 3];
  for (int at : {0, 1, 2, 3}) {  // from even and odd addresses on
    Eigen::Map<Mat3> moved(memory + at), product(memory + 9 + at % 2);
    moved = a;
    EXPECT_EQ(Mat3(moved * b), expected) << at;
    product = a * b;
    EXPECT_EQ(product, expected) << at;
  }
  const Eigen::Matrix<double, 7, 12> J = any<Eigen::Matrix<double, 7, 12>>();
  const Eigen::Matrix<double, 12, 1> x = any<Eigen::Matrix<double, 12, 1>>();
  const Eigen::Matrix<double, 7, 1> y = J * x;
  for (int i = 0; i < 7; ++i) {
    double sum = 0;
    for (int k = 0; k < 12; ++k) sum += J(i, k) * x[k];
    EXPECT_EQ(y[i], sum) << i;
  }
}

TEST_P(SmallMatrices, OfDualsAreThoseOfTheirValuesAndRates) {
  using D = Dual<1>;
  using DualMat3 = Eigen::Matrix<D, 3, 3>;
  const Mat3 a = any<Mat3>(), b = any<Mat3>(), da = any<Mat3>(), db = any<Mat3>();
  DualMat3 x, y;
  for (int i = 0; i < 9; ++i) {
    x(i) = a(i), y(i) = b(i);
    x(i).rate[0] = da(i), y(i).rate[0] = db(i);
  }
  const DualMat3 product = x * y, sum = 2.0 * x - y;
  const Mat3 value = a * b, rate = da * b + a * db;
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(product(i).value, value(i));
    EXPECT_TRUE(std::abs(product(i).rate[0] - rate(i)) <= 1e-14 * 60) << product(i).rate[0] - rate(i);
    EXPECT_EQ(sum(i).value, 2 * a(i) - b(i));
    EXPECT_EQ(sum(i).rate[0], 2 * da(i) - db(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SmallMatrices, testing::Range(1u, 21u));

TEST(SmallMatricesTypes, AreValuesWhereSizesAreFixedAndEigensElsewhere) {
  const Mat3 a = Mat3::Identity();
  const Eigen::Matrix3Xd wide = Eigen::Matrix3Xd::Zero(3, 4);
  EXPECT_TRUE((std::is_same_v<decltype(a + a), Mat3>));
  EXPECT_TRUE((std::is_same_v<decltype(2 * a.row(1)), Eigen::RowVector3d>));
  EXPECT_TRUE((std::is_same_v<decltype(a * a.col(1)), Vec3>));
  EXPECT_FALSE((std::is_same_v<decltype(wide + wide), Eigen::Matrix3Xd>));  // an expression
  EXPECT_FALSE((std::is_same_v<decltype(a * wide), Eigen::Matrix3Xd>));
  EXPECT_EQ(Eigen::Matrix3Xd(a * wide), wide);
  EXPECT_EQ(Eigen::Matrix3Xd(wide + wide), wide);
}

}  // namespace
}  // namespace carom
