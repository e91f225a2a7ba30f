// SPDX-License-Identifier: MIT
// Distributions of controls: moments, what bounds cut off, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "explore/worlds/exploration.h"
#include "tests/explore/throws.h"
#include "tests/support/scaled.h"

namespace carom {
namespace {

using namespace explore_test;

/// A ball that flies for an instant: worlds cost little.
Throw flight(std::vector<Control> controls) {
  Throw t = bouncingBall();
  t.duration = 1e-3, t.controls = std::move(controls), t.constraints.clear();
  return t;
}

struct Moments {
  Eigen::VectorXd mean, least, most;
  Eigen::MatrixXd covariance;
};

Moments momentsOf(const WorldTable& table) {
  const auto n = static_cast<Eigen::Index>(table.numbers), count = static_cast<Eigen::Index>(table.size());
  const Eigen::MatrixXd x =
      Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(table.drawn.data(), count, n);
  const Eigen::MatrixXd centred = x.rowwise() - x.colwise().mean();
  return {x.colwise().mean(), x.colwise().minCoeff(), x.colwise().maxCoeff(),
          centred.transpose() * centred / (count - 1)};
}

TEST(Draws, HaveTheMomentsOfTheirDistributions) {
  const int count = test::scaled(20000);
  const Throw t = flight({drawn(velocity("ball"), NormalDistribution{{1, 2, 3}, {0.1, 0.2, 0.3}}),
                          drawn(angularVelocity("ball"), NormalDistribution{{0}, {}, {{1, 0}, {3, 4}, {0, 2}}}),
                          drawn(elasticity("m"), UniformDistribution{{0.2}, {0.8}}),
                          drawn(friction("m"), LogNormalDistribution{{}, {0.5}})});
  for (const Points points : {Points::random, Points::sobol}) {
    const Moments m = momentsOf(exploring(t, {.points = points}).chunk(0, static_cast<std::uint64_t>(count)));
    const double e = 4.5 / std::sqrt(count);
    const double log_variance = 0.25, log_mean = 0.3 * std::exp(log_variance / 2);
    const double mean[] = {1, 2, 3, 0, 0, 0, 0.5, log_mean};
    const double variance[] = {0.01, 0.04, 0.09, 1, 25, 4, 0.03, log_mean * log_mean * (std::exp(log_variance) - 1)};
    for (int k = 0; k < 8; ++k) {
      EXPECT_TRUE(std::abs(m.mean[k] - mean[k]) <= e * std::sqrt(variance[k])) << k;
      EXPECT_TRUE(std::abs(m.covariance(k, k) - variance[k]) <= 2.5 * e * variance[k]) << k;
    }
    EXPECT_TRUE(std::abs(m.covariance(3, 4) - 3) <= e * 6);  // F F^T
    EXPECT_TRUE(std::abs(m.covariance(4, 5) - 8) <= e * 14);
    EXPECT_TRUE(std::abs(m.covariance(0, 1)) <= e * 0.02);
  }
}

// Cut off at a bound above the mean a normal distribution is that of a half, scaled: mean 0 + sqrt(2 / pi).
TEST(Draws, AreCutOffAtBoundsAndItIsSaid) {
  const int count = test::scaled(20000);
  const Exploration e = exploring(flight(
      {drawn(velocity("ball").only({"x"}).atLeast(0), NormalDistribution{{0}, {1}}),
       drawn(velocity("ball").only({"y"}).within(9, 9.5), NormalDistribution{{0}, {1}}),
       drawn(elasticity("m"), UniformDistribution{{0.5}, {1.5}}), drawn(mass("ball"), NormalDistribution{{1}, {1}})}));
  const Moments m = momentsOf(e.chunk(0, static_cast<std::uint64_t>(count)));
  EXPECT_TRUE(std::abs(m.mean[0] - std::sqrt(2 / M_PI)) <= 4.5 * 0.6 / std::sqrt(count));
  EXPECT_GE(m.least[0], 0);
  EXPECT_TRUE(m.least[1] >= 9 && m.most[1] <= 9.5);
  // Far out a normal distribution falls like an exponential one: E[z - 9 | z > 9] = 0.10857..., by 50 digits 0.108516.
  EXPECT_TRUE(std::abs(m.mean[1] - 9.1085) <= 0.003 + 4.5 * 0.1 / std::sqrt(count)) << m.mean[1];
  EXPECT_TRUE(m.least[2] >= 0.5 && m.most[2] <= 1);
  EXPECT_GT(m.least[3], 0);
  ASSERT_EQ(e.notes().size(), 4u);
  EXPECT_EQ(e.notes()[0],
            "50 % of the distribution of velocity.x of 'ball' lies outside of its bounds and is cut off.");
  EXPECT_EQ(e.notes()[2], "50 % of the distribution of elasticity of 'm' lies outside of its bounds and is cut off.");
  EXPECT_EQ(e.notes()[3], "15.9 % of the distribution of mass of 'ball' lies outside of its bounds and is cut off.");
}

// A joint distribution is not cut off: worlds outside are not simulated.
TEST(Draws, OfAJointDistributionSomeLieOutside) {
  const Exploration e = exploring(
      flight({drawn(velocity("ball").only({"x", "y"}).atLeast(0), NormalDistribution{{0}, {}, {{1, 0}, {0, 1}}})}));
  const WorldTable table = e.chunk(0, 4000);
  const auto outside =
      static_cast<double>(std::count(table.status.begin(), table.status.end(), world_status::kOutside));
  EXPECT_TRUE(std::abs(outside / 4000 - 0.75) <= 4.5 * std::sqrt(0.75 * 0.25 / 4000));
  for (std::size_t k = 0; k < table.size(); ++k) {
    const bool is_inside = table.drawn[2 * k] >= 0 && table.drawn[2 * k + 1] >= 0;
    EXPECT_EQ(table.status[k] == world_status::kOutside, !is_inside);
    EXPECT_EQ(std::isnan(table.end[k]), !is_inside);
  }
  EXPECT_EQ(e.notes().size(), 2u);
}

std::string refusal(std::vector<Control> controls, const ExploreOptions& options = {}) {
  try {
    exploring(flight(std::move(controls)), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Draws, RefuseByPointer) {
  const auto starts = [](const std::string& text, const std::string& with) {
    EXPECT_EQ(text.substr(0, with.size()), with) << text;
  };
  starts(refusal({velocity("ball")}), "/controls: found no \"distribution\"");
  starts(refusal({mass("ball"), drawn(elasticity("m"), UniformDistribution{{1.5}, {2}})}),
         "/controls/1/distribution/uniform: found nothing of the distribution of elasticity of 'm' within its bounds, "
         "0 to 1");
  starts(refusal({drawn(mass("ball"), UniformDistribution{{-2}, {-1}})}),
         "/controls/0/distribution/uniform: found nothing");
  starts(refusal({drawn(mass("ball"), NormalDistribution{{-100}, {1}})}),
         "/controls/0/distribution/normal: found nothing");
  starts(refusal({drawn(mass("ball"), LogNormalDistribution{{-1}, {1}})}),
         "/controls/0/distribution/log_normal/median: found -1");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{1, 2}, {1}})}),
         "/controls/0/distribution/normal/mean: found 2 numbers, expected 1 or 3");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {0}})}),
         "/controls/0/distribution/normal/deviation: found 0");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {std::nan("")}})}),
         "/controls/0/distribution/normal/deviation: found nan");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {}})}),
         "/controls/0/distribution/normal: found neither");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {1}, {{1}}})}),
         "/controls/0/distribution/normal/factor: found a factor beside");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {}, {{1}}})}),
         "/controls/0/distribution/normal/factor: found 1 rows, expected 3");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {}, {{1}, {1, 2}, {1}}})}),
         "/controls/0/distribution/normal/factor/1: found 2 numbers");
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {}, {{1}, {0}, {1}}})}),
         "/controls/0/distribution/normal/factor/1: found a row");
  starts(refusal({drawn(velocity("ball"), UniformDistribution{{1}, {0}})}),
         "/controls/0/distribution/uniform/from: found 1");
  starts(refusal({drawn(velocity("ball"), UniformOrientation{})}), "/controls/0/distribution: found every orientation");
  starts(refusal({drawn(orientation("ball").only({"x"}), UniformOrientation{})}),
         "/controls/0/distribution: found every orientation");
  starts(refusal({drawn(velocity("nobody"), UniformDistribution{{0}, {1}})}), "/controls/0/body: ");
  std::vector<std::vector<double>> wide(3, std::vector<double>(65, 1));
  starts(refusal({drawn(velocity("ball"), NormalDistribution{{}, {}, wide})}, {.points = Points::sobol}),
         "/controls: found distributions of 65 numbers, expected at most 64");
}

}  // namespace
}  // namespace carom
