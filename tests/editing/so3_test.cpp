// SPDX-License-Identifier: MIT
// Rotation vectors against 100-digit arithmetic and against their definitions.

#include "adjoint/numeric/so3.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace carom {

using namespace adjoint_detail;

namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
using Real3 = Eigen::Matrix<double, 3, 1>;

struct BigMatrix {
  Real m[3][3];
};

/// [u]x^k summed with the weights of a power series, in 50 digits: sum_k [u]x^k / (k + offset)!.
BigMatrix series(const Real u[3], int offset) {
  const Real U[3][3] = {{0, -u[2], u[1]}, {u[2], 0, -u[0]}, {-u[1], u[0], 0}};
  BigMatrix sum{}, power{};
  Real factorial = 1;
  for (int k = 1; k <= offset; ++k) factorial *= k;
  for (int i = 0; i < 3; ++i) power.m[i][i] = 1;
  for (int k = 0; k < 80; ++k) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sum.m[i][j] += power.m[i][j] / factorial;
    }
    BigMatrix next{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        for (int l = 0; l < 3; ++l) next.m[i][j] += power.m[i][l] * U[l][j];
      }
    }
    power = next;
    factorial *= k + 1 + offset;
  }
  return sum;
}

Mat3 seriesOf(const Vec3& u, int offset) {
  const Real big[3] = {u.x(), u.y(), u.z()};
  const BigMatrix sum = series(big, offset);
  Mat3 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = static_cast<double>(sum.m[i][j]);
  }
  return m;
}

std::vector<Vec3> rotationVectors() {
  const Vec3 axis = Vec3(0.3, -0.8, 0.5).normalized();
  std::vector<Vec3> all{Vec3::Zero()};
  for (double angle : {1e-12, 1e-8, 1e-5, 1e-3, 0.0199, 0.0201, 0.1, 1.0, 2.0, 3.0, 3.14, 3.1415926}) {
    all.push_back(angle * axis);
    all.push_back(-angle * Vec3::UnitX());
  }
  return all;
}

void expectNear(const Mat3& found, const Mat3& expected, double tolerance, const Vec3& u) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      EXPECT_TRUE(std::abs(found(i, j) - expected(i, j)) <= tolerance)
          << found(i, j) - expected(i, j) << " at " << i << ", " << j << " of " << u.transpose();
    }
  }
}

TEST(So3, ExpIsTheExponential) {
  for (const Vec3& u : rotationVectors()) expectNear(expSO3(u).toRotationMatrix(), seriesOf(u, 0), 4e-16 * 4, u);
}

// J = sum [u]x^k / (k+1)!
TEST(So3, LeftJacobianIsItsSeries) {
  for (const Vec3& u : rotationVectors()) expectNear(leftJacobian(u), seriesOf(u, 1), 2e-14, u);
}

TEST(So3, LeftJacobianInverseIsTheInverse) {
  for (const Vec3& u : rotationVectors()) {
    expectNear(leftJacobianInverse(u) * seriesOf(u, 1), Mat3::Identity(), 2e-14, u);
  }
}

TEST(So3, LogInvertsExp) {
  for (const Vec3& u : rotationVectors()) {
    EXPECT_LE((logSO3(expSO3(u)) - u).norm(), 1e-15 * (1 + u.norm()) * 4) << u.transpose();
    const Quat minus(-expSO3(u).coeffs());
    EXPECT_LE((logSO3(minus) - u).norm(), 1e-15 * (1 + u.norm()) * 4) << u.transpose();
  }
}

TEST(So3, LogNearAHalfTurn) {
  const double pi = std::numbers::pi;
  EXPECT_NEAR(logSO3(Quat(0, 1, 0, 0)).norm(), pi, 1e-15);
  const Vec3 beyond = (pi + 1e-9) * Vec3::UnitY();
  EXPECT_LE((logSO3(expSO3(beyond)) + (pi - 1e-9) * Vec3::UnitY()).norm(), 1e-14);
}

}  // namespace
}  // namespace carom
