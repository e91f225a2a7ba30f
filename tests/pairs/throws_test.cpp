#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "adjoint/errors.h"
#include "tests/pairs/compare_impact.h"
#include "tests/support/throws.h"

// Random throws of every kind of shape at every other, in both orders, against the brute-force answer.
// CAROM_TEST_SCALE multiplies their number; CAROM_TEST_SEED runs one seed of every pair, which failures name.

namespace carom::pairs {
namespace {

constexpr int kImpacts = 200;  // of each ordered pair
constexpr int kMostFailures = 5;

class Throws : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
 protected:
  /// False when the two differ.
  bool agree(std::uint64_t seed, Agreement& agreement) const {
    const auto& rows = test::shapeMakers();
    const test::Throw thrown = test::randomThrow(rows[std::get<0>(GetParam())], rows[std::get<1>(GetParam())], seed);
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
  const auto &a = test::shapeMakers()[std::get<0>(GetParam())], &b = test::shapeMakers()[std::get<1>(GetParam())];
  if (!a.moves && !b.moves) GTEST_SKIP() << "both stand still";
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

std::string pairName(const testing::TestParamInfo<std::tuple<std::size_t, std::size_t>>& row) {
  const auto& rows = test::shapeMakers();
  return std::string(rows[std::get<0>(row.param)].name) + "_on_" + rows[std::get<1>(row.param)].name;
}
INSTANTIATE_TEST_SUITE_P(Kinds, Throws,
                         testing::Combine(testing::Range<std::size_t>(0, test::shapeMakers().size()),
                                          testing::Range<std::size_t>(0, test::shapeMakers().size())),
                         pairName);

}  // namespace
}  // namespace carom::pairs
