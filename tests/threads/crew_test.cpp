// SPDX-License-Identifier: MIT
// Works that a crew does in any order, and in order but for a few at a time.

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "editing/detail/parallel.hpp"

namespace carom {
namespace {

using editing_detail::Crew;

class Crews : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, Crews, testing::Values(0, 1, 2, 5));

TEST_P(Crews, DoEveryWorkOnce) {
  Crew crew(GetParam());
  for (const std::size_t count : {0, 1, 2, 100}) {
    std::vector<std::atomic<int>> done(count);
    crew.forAll(count, [&](std::size_t i) { ++done[i]; });
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(done[i], 1) << i << " of " << count;
  }
}

TEST_P(Crews, BeginAWorkWhenThoseFarEnoughBeforeItAreDone) {
  Crew crew(GetParam());
  for (const std::size_t ahead : {1, 2, 4, 100}) {
    constexpr std::size_t kCount = 200;
    std::vector<std::atomic<int>> done(kCount);
    std::vector<char> too_early(kCount, 0);
    crew.inOrder(kCount, ahead, [&](std::size_t i) {
      for (std::size_t k = 0; k + ahead <= i; ++k) too_early[i] |= done[k] != 1;
      ++done[i];
    });
    for (std::size_t i = 0; i < kCount; ++i) {
      EXPECT_EQ(done[i], 1) << i << ", " << ahead << " ahead";
      EXPECT_FALSE(too_early[i]) << i << ", " << ahead << " ahead";
    }
  }
}

TEST_P(Crews, HandOnWhatAWorkThrows) {
  Crew crew(GetParam());
  const auto fails = [](std::size_t i) {
    if (i == 7) throw std::runtime_error("the seventh");
  };
  EXPECT_THROW(crew.forAll(20, fails), std::runtime_error);
  EXPECT_THROW(crew.inOrder(20, 3, fails), std::runtime_error);
  std::atomic<int> done = 0;
  crew.inOrder(20, 3, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 20);
}

}  // namespace
}  // namespace carom
