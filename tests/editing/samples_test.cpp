// SPDX-License-Identifier: MIT
// Where the samples of a search lie.

#include "editing/strategy/samples.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace carom {

using namespace editing_detail;

namespace {

TEST(Samples, AreWithinBoundsAndTheSameInParts) {
  const Eigen::VectorXd centre = Eigen::VectorXd::Zero(3);
  const Eigen::VectorXd lower = Eigen::Vector3d(-0.1, -1, -5), upper = Eigen::Vector3d(0.2, 1, 0);
  const std::vector<Surroundings> around = {{centre, Eigen::Vector3d(0.3, 0, 0), Eigen::MatrixXd::Identity(3, 2)}};
  const auto all = samples(centre, around, lower, upper, 0, 60), rest = samples(centre, around, lower, upper, 40, 20);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_TRUE((all[i].array() >= lower.array()).all() && (all[i].array() <= upper.array()).all()) << i;
    EXPECT_TRUE(i < 40 || all[i] == rest[i - 40]) << i;
  }
}

// Of three dimensions two rows span a plane: samples of it stay within the reach and within 30 degrees of it, on all sides.
TEST(Samples, AreNearlySpannedByGradientsWhereASmallerChangeIsSought) {
  const Eigen::VectorXd centre = Eigen::VectorXd::Zero(3), far = Eigen::VectorXd::Constant(3, 10);
  const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(3, 3);
  const std::vector<Surroundings> around = {{centre, Eigen::Vector3d::Zero(), all.rightCols(1)}};
  const SampleReach known{0.5, true};
  const int kinds = 5, each = 200;
  const auto list = samples(centre, around, -far, far, 0, kinds * each, known);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  int within = 0, exactly = 0;
  for (int k = 0; k < each; ++k) {
    const Eigen::VectorXd& x = list[static_cast<std::size_t>(kinds * k + kinds - 1)];
    EXPECT_LE(x.norm(), known.length * (1 + 1e-15));
    EXPECT_LE(std::abs(x[2]), (0.5 + 1e-12) * x.norm());
    within += x.norm() < known.length / std::sqrt(2.0);
    exactly += x[2] == 0;
    mean += x / each;
  }
  EXPECT_EQ(exactly, each / 5);
  EXPECT_NEAR(within, each / 2, 5);  // as even as the area
  EXPECT_LT(mean.norm(), 0.03) << mean.transpose();
  // none where no smaller change is known, or all directions are free: then every fourth sample is one of a box
  const auto unknown = samples(centre, around, -far, far, 0, 60, {0.5, false});
  const std::vector<Surroundings> unbound = {{centre, Eigen::Vector3d::Zero(), all}};
  for (const bool of_known : {false, true}) {
    const SampleReach as_far{0.5, of_known};
    const auto none = samples(centre, unbound, -far, far, 0, 60, as_far), boxes = samples(centre, {}, -far, far, 0, 30, as_far);
    for (std::size_t k = 0; k < 15; ++k) {
      EXPECT_EQ(none[4 * k], boxes[2 * k]) << k;
      if (!of_known) EXPECT_EQ(unknown[4 * k], boxes[2 * k]) << k;
    }
  }
}

TEST(Samples, OfSingleNumbersLieWithinTheirBoundsAndNeverTwiceAtAPlace) {
  const Eigen::VectorXd centre = Eigen::Vector2d(0.1, -0.2);
  const Eigen::VectorXd lower = centre - Eigen::VectorXd::Constant(2, 0.3), upper = centre + Eigen::Vector2d(0.05, 8);
  const int kinds = 2, count = 500;
  for (const bool of_known : {false, true}) {
    const auto list = samples(centre, {}, lower, upper, 0, kinds * count, {3, of_known});
    std::set<std::vector<double>> places;
    double farthest = 0;
    for (std::size_t k = 1; k < list.size(); k += kinds) {
      const Eigen::VectorXd& x = list[k];
      EXPECT_EQ((x.array() == centre.array()).count(), 1) << k;
      EXPECT_TRUE((x.array() > lower.array()).all() && (x.array() < upper.array()).all()) << x.transpose();
      places.insert({x[0], x[1]});
      farthest = std::max(farthest, x[1] - centre[1]);
    }
    EXPECT_EQ(places.size(), static_cast<std::size_t>(count));
    EXPECT_NEAR(farthest, 3, 1e-12);
  }
}

TEST(Samples, CoverTheCubeAndTheSphere) {
  const EvenPoints points(3);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::Zero();
  const int count = 1000;
  for (int k = 0; k < count; ++k) {
    mean += points.inCube(k) / count;
    direction += points.onSphere(k) / count;
    EXPECT_NEAR(points.onSphere(k).norm(), 1, 1e-12);
  }
  EXPECT_TRUE((mean - Eigen::Vector3d::Constant(0.5)).cwiseAbs().maxCoeff() < 0.01) << mean.transpose();
  EXPECT_TRUE(direction.norm() < 0.05) << direction.transpose();
}

TEST(Samples, KeepWhatHasNoInfluenceInThreeOfFour) {
  const Eigen::VectorXd start = Eigen::Vector3d(1, 2, 3);
  const std::vector<Eigen::VectorXd> made(64, Eigen::Vector3d(4, 5, 6));
  std::vector<Eigen::VectorXd> places = made;
  keepInMost(places, start, {});
  EXPECT_EQ(places, made);
  keepInMost(places, start, {1, 0, 1});
  std::size_t all_vary[8] = {};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool varies = places[i][1] == 5;
    EXPECT_EQ(places[i], Eigen::VectorXd(Eigen::Vector3d(4, varies ? 5 : 2, 6))) << i;
    all_vary[i % 8] += varies;
  }
  for (const std::size_t times : all_vary) EXPECT_EQ(times, places.size() / 8 / 4);  // of each kind as often
}

TEST(RoundedPoint, IsTheSameButForRounding) {
  const Eigen::VectorXd x = Eigen::Vector3d(0.18620000000012, -0.0812, 0);
  Eigen::VectorXd rounded = x, other = x;
  rounded[0] += 1e-16, rounded[2] = -1e-17;  // -0 is 0
  other[1] += 2e-9;
  const RoundedPoint place(x);
  EXPECT_EQ(place, RoundedPoint(rounded));
  EXPECT_NE(place, RoundedPoint(other));
  EXPECT_LT(place, RoundedPoint(other));
  EXPECT_EQ((std::set<RoundedPoint>{place, RoundedPoint(rounded), RoundedPoint(other)}.size()), 2u);
}

}  // namespace
}  // namespace carom
