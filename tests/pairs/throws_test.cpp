// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "adjoint/base/errors.h"
#include "tests/pairs/compare_impact.h"
#include "tests/support/throws.h"

// Random throws of every kind of shape at every other, in both orders, against the brute-force answer.
// CAROM_TEST_SCALE multiplies their number; CAROM_TEST_SEED runs one seed of every pair, which failures name.

namespace carom::pairs {
namespace {

constexpr int kImpacts = 100;  // of each ordered pair

class Throws : public testing::TestWithParam<test::ShapePair> {
 protected:
  /// False when the two differ.
  bool agree(std::uint64_t seed, Agreement& agreement) const {
    const test::Throw thrown = test::randomThrow(*GetParam().a, *GetParam().b, seed);
    std::string difference;
    try {
      const auto expected = Encounter(thrown.scene).firstImpact(thrown.duration);
      difference = agreement.compare(firstFound(thrown.scene, thrown.duration), expected);
    } catch (const std::exception& error) {
      difference = error.what();
    }
    EXPECT_EQ(difference, "") << "seed " << seed << " (CAROM_TEST_SEED=" << seed << "):\n" << test::describe(thrown);
    return difference.empty();
  }
};

TEST_P(Throws, agreeWithBruteForce) {
  const test::ShapeMaker &a = *GetParam().a, &b = *GetParam().b;
  Agreement agreement;
  if (const char* seed = std::getenv("CAROM_TEST_SEED")) {
    agree(std::strtoull(seed, nullptr, 10), agreement);
    return;
  }
  const int wanted = scaled(kImpacts);
  int failures = 0;
  for (std::uint64_t seed = 1; agreement.impacts < wanted && failures < kMostFailures; ++seed) {
    ASSERT_LE(seed, 3u * static_cast<unsigned>(wanted) + 20) << "too few of the throws hit";
    failures += !agree(seed, agreement);
  }
  std::printf("%s on %s: %s\n", a.name, b.name, agreement.summary().c_str());
  EXPECT_LE(50 * agreement.doubtful, wanted + 100) << "more than one throw in fifty had to be replaced";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Throws, testing::ValuesIn(test::pairsThatMeet()),
                         [](const auto& row) { return row.param.name(); });

}  // namespace
}  // namespace carom::pairs
