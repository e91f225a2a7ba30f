// SPDX-License-Identifier: MIT
// Probabilities that are known, and what a table is summed up to.
#include <gtest/gtest.h>

#include <cmath>

#include "explore/explore.h"
#include "explore/worlds/summary.h"
#include "tests/explore/throws.h"
#include "tests/support/scaled.h"

namespace carom {
namespace {

using namespace explore_test;

double normalAbove(double z) { return std::erfc(z / std::sqrt(2)) / 2; }

// P(vz > v*) = Phi((mean - v*) / deviation). At scale 50 these are 10^6 worlds.
TEST(Probability, OfABallOverAWallIsThatOfTheClosedForm) {
  const auto count = static_cast<std::uint64_t>(test::scaled(20000));
  const double clearing = clearingSpeed(), p = normalAbove((clearing - kMeanSpeed) / kSpeedDeviation);
  ASSERT_TRUE(p > 0.2 && p < 0.8) << p;
  for (const Points points : {Points::random, Points::sobol}) {
    const Exploration exploration = exploring(ballOverWall(), {.points = points});
    const WorldTable table = explore(exploration, count);
    std::uint64_t over = 0, beyond = 0;
    for (std::size_t k = 0; k < table.size(); ++k) {
      EXPECT_EQ(table.impacts[k] == 0, table.drawn[k] > clearing) << table.drawn[k] - clearing;
      over += table.impacts[k] == 0;
      beyond += table.values[k] >= 2.2;
    }
    const double error = std::sqrt(p * (1 - p) / static_cast<double>(count));
    const double off = static_cast<double>(over) / static_cast<double>(count) - p;
    EXPECT_TRUE(std::abs(off) <= (points == Points::random ? 4 * error : 40 / static_cast<double>(count)))
        << off << " " << error;
    const ExploreSummary summary = summarise(exploration, table);
    EXPECT_EQ(summary.met.count, beyond);
    EXPECT_EQ(summary.rows[0].within.count, beyond);
    std::uint64_t all = 0;
    for (const Outcome& outcome : summary.outcomes) all += outcome.share.count;
    EXPECT_EQ(all, count);
    EXPECT_EQ(summary.worlds, count);
  }
}

// Every orientation of a cube is as likely as those turned by its own symmetry: each face is up in a sixth of the
// worlds.
TEST(Probability, OfEveryFaceOfADieIsASixth) {
  const auto count = static_cast<std::uint64_t>(test::scaled(240));
  const Exploration exploration = exploring(droppedDie());
  const WorldTable table = explore(exploration, count);
  const ExploreSummary summary = summarise(exploration, table);
  ASSERT_EQ(summary.faces.size(), 1u);
  EXPECT_EQ(summary.faces[0].box, "die");
  double chi = 0, known = 0;
  for (int face = 1; face <= 6; ++face)
    known += static_cast<double>(summary.faces[0].faces[static_cast<std::size_t>(face)].count);
  for (int face = 1; face <= 6; ++face) {
    const double off = static_cast<double>(summary.faces[0].faces[static_cast<std::size_t>(face)].count) - known / 6;
    chi += off * off / (known / 6);
  }
  EXPECT_LE(chi, 25.7);  // 1 in 10 000, with 5 degrees of freedom
  EXPECT_GE(known, 0.99 * static_cast<double>(count));
}

// Wilson's interval: scipy.stats.binomtest(k, n).proportion_ci(0.95, method="wilson") of SciPy 1.17.1.
TEST(Share, HasWilsonsInterval) {
  const auto near = [](double a, double b) { EXPECT_TRUE(std::abs(a - b) <= 1e-15) << a << " " << b; };
  near(shareOf(0, 50).lower, 0), near(shareOf(0, 50).upper, 0.07134759913335872);
  near(shareOf(10, 100).lower, 0.05522913706067508), near(shareOf(10, 100).upper, 0.17436566150491345);
  near(shareOf(50, 50).lower, 0.9286524008666412), near(shareOf(50, 50).upper, 1);
  near(shareOf(333, 1000).lower, 0.3044779033483562), near(shareOf(333, 1000).upper, 0.3628002339858192);
  EXPECT_EQ(shareOf(0, 0).lower, 0);
  EXPECT_EQ(shareOf(0, 0).upper, 1);
}

TEST(Summary, HasTheNearestWorldsAndQuantiles) {
  const Exploration exploration = exploring(bouncingBall());
  const WorldTable table = exploration.chunk(0, 500);
  const std::vector<NearWorld> near = nearestWorlds(exploration, table, 5);
  ASSERT_EQ(near.size(), 5u);
  const auto distance = [&](std::size_t k) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const ExploredRow& row = exploration.rows()[i];
      const double v = table.values[3 * k + i], off = (v < row.lower   ? v - row.lower
                                                       : v > row.upper ? v - row.upper
                                                                       : 0) /
                                                      row.scale;
      sum += off * off;
    }
    return std::sqrt(sum);
  };
  for (std::size_t k = 0; k < near.size(); ++k) {
    EXPECT_EQ(near[k].distance, distance(near[k].world));
    if (k > 0) EXPECT_GE(near[k].distance, near[k - 1].distance);
  }
  for (std::size_t k = 0; k < table.size(); ++k)
    if (!(table.status[k] & world_status::kMissingRow)) EXPECT_GE(distance(k), near[0].distance);
  const ExploreSummary summary = summarise(exploration, table);
  for (const RowSummary& row : summary.rows) {
    EXPECT_TRUE(row.quantiles[0] <= row.quantiles[1] && row.quantiles[1] <= row.quantiles[2] &&
                row.quantiles[3] <= row.quantiles[4]);
    EXPECT_TRUE(std::abs(row.mean - row.quantiles[2]) <= row.deviation);
  }
  EXPECT_EQ(summary.met.count, static_cast<std::uint64_t>([&] {
              long n = 0;
              for (std::size_t k = 0; k < table.size(); ++k)
                n += !(table.status[k] & world_status::kMissingRow) && table.values[3 * k + 1] >= 1.5 &&
                     table.values[3 * k + 1] <= 2.5;
              return n;
            }()));
}

// No world at all, and none that has a motion.
TEST(Summary, OfNothingKnowsNothing) {
  const Exploration exploration = exploring(bouncingBall());
  const ExploreSummary none = summarise(exploration, exploration.chunk(0, 0));
  EXPECT_EQ(none.met.upper, 1);
  EXPECT_TRUE(std::isnan(none.rows[0].mean));
  EXPECT_TRUE(nearestWorlds(exploration, exploration.chunk(0, 0), 3).empty());
}

}  // namespace
}  // namespace carom
