// SPDX-License-Identifier: MIT
#include "editing/solve/dependence.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/support/compare.h"

namespace carom {
using namespace editing_detail;

namespace {

using test::expectEntries;

Eigen::MatrixXd randomMatrix(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd m(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) m(i, j) = normal(random);
  }
  return m;
}

TEST(Dependence, FullRankHasNothingToSay) {
  const RowSplit split = splitRows(randomMatrix(4, 9, 1));
  EXPECT_EQ(split.independent, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_TRUE(split.zero.empty());
  EXPECT_TRUE(split.dependent.empty());
}

TEST(Dependence, FindsZeroRows) {
  Eigen::MatrixXd m = randomMatrix(3, 5, 2);
  m.row(1).setZero();
  const RowSplit split = splitRows(m);
  EXPECT_EQ(split.zero, std::vector<int>{1});
  EXPECT_EQ(split.independent, (std::vector<int>{0, 2}));
}

TEST(Dependence, ARowWithNanIsNotUsed) {
  Eigen::MatrixXd m = randomMatrix(3, 5, 3);
  m(2, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(splitRows(m).zero, std::vector<int>{2});
}

TEST(Dependence, SmallRowsAreJudgedByDirection) {
  Eigen::MatrixXd m = randomMatrix(3, 5, 4);
  m.row(2) *= 1e-8;
  EXPECT_EQ(splitRows(m).independent.size(), 3u);
}

TEST(Dependence, GivesTheWeightsOfACombination) {
  Eigen::MatrixXd m = randomMatrix(4, 6, 5);
  m.row(3) = 2 * m.row(0) - 1e3 * m.row(1);
  const RowSplit split = splitRows(m);
  ASSERT_EQ(split.independent.size(), 3u);
  ASSERT_EQ(split.dependent.size(), 1u);
  const DependentRow& row = split.dependent[0];
  Eigen::RowVectorXd rebuilt = Eigen::RowVectorXd::Zero(6);
  for (int k = 0; k < 3; ++k) rebuilt += row.weights[k] * m.row(split.independent[static_cast<std::size_t>(k)]);
  EXPECT_LT((rebuilt - m.row(row.row)).norm(), 1e-10 * m.row(row.row).norm());
}

TEST(Dependence, TellsDuplicateFromContradiction) {
  Eigen::MatrixXd m = randomMatrix(3, 6, 6);
  m.row(2) = m.row(0);
  const RowSplit split = splitRows(m);
  ASSERT_EQ(split.dependent.size(), 1u);
  EXPECT_EQ(split.dependent[0].on.size(), 1u);
  EXPECT_NEAR(contradictionOf(split, split.dependent[0], Eigen::Vector3d(0.5, 0.1, 0.5)), 0, 1e-12);
  EXPECT_NEAR(std::abs(contradictionOf(split, split.dependent[0], Eigen::Vector3d(0.5, 0.1, 0.7))), 0.2, 1e-12);
}

TEST(Dependence, MoreRowsThanColumns) {
  const RowSplit split = splitRows(randomMatrix(7, 3, 7));
  EXPECT_EQ(split.independent.size(), 3u);
  EXPECT_EQ(split.dependent.size(), 4u);
}

TEST(Dependence, NullSpaceIsAnOrthonormalBasisOfWhatChangesNoRow) {
  Eigen::MatrixXd m = randomMatrix(4, 7, 8);
  m.row(3) = m.row(0) - 2 * m.row(1);  // rank 3
  const Eigen::MatrixXd Z = nullSpace(m);
  ASSERT_EQ(Z.rows(), 7);
  ASSERT_EQ(Z.cols(), 4);
  expectEntries(m * Z, Eigen::MatrixXd::Zero(4, 4), 1e-14, "J Z", 1);
  expectEntries(Z.transpose() * Z, Eigen::MatrixXd::Identity(4, 4), 1e-14, "Z'Z", 1);
}

TEST(Dependence, NullSpaceJudgesNearlyDependentRowsByTheTolerance) {
  Eigen::MatrixXd m = randomMatrix(2, 5, 9);
  m.row(1) = m.row(0) + 1e-10 * m.row(1);
  EXPECT_EQ(nullSpace(m).cols(), 4);
  EXPECT_EQ(nullSpace(m, 1e-12).cols(), 3);
}

TEST(Dependence, NullSpaceAtItsEnds) {
  EXPECT_EQ(nullSpace(randomMatrix(3, 3, 10)).cols(), 0);
  EXPECT_EQ(nullSpace(Eigen::MatrixXd(0, 3)), Eigen::MatrixXd(Eigen::MatrixXd::Identity(3, 3)));
  EXPECT_EQ(nullSpace(Eigen::MatrixXd(2, 0)).size(), 0);
}

TEST(Dependence, NoColumns) { EXPECT_EQ(splitRows(Eigen::MatrixXd(2, 0)).zero.size(), 2u); }

}  // namespace
}  // namespace carom
