// SPDX-License-Identifier: MIT
// Sums and multiples of small matrices have the bits of Eigen's, and are Eigen's own where a size is not fixed.

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

TEST_P(SmallMatrices, OfDualsAreThoseOfTheirValuesAndRates) {
  using D = Dual<1>;
  using DualMat3 = Eigen::Matrix<D, 3, 3>;
  const Mat3 a = any<Mat3>(), b = any<Mat3>(), da = any<Mat3>(), db = any<Mat3>();
  DualMat3 x, y;
  for (int i = 0; i < 9; ++i) {
    x(i) = a(i), y(i) = b(i);
    x(i).rate[0] = da(i), y(i).rate[0] = db(i);
  }
  const DualMat3 sum = 2.0 * x - y;
  for (int i = 0; i < 9; ++i) {
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
  EXPECT_FALSE((std::is_same_v<decltype(wide + wide), Eigen::Matrix3Xd>));  // an expression
  EXPECT_EQ(Eigen::Matrix3Xd(wide + wide), wide);
}

}  // namespace
}  // namespace carom
