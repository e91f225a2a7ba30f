// SPDX-License-Identifier: MIT
// Tasks that a pool runs in any order, and in order but for a few at a time.

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "editing/detail/parallel.hpp"

namespace carom {
namespace {

using editing_detail::ThreadPool;

class ThreadPools : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Threads, ThreadPools, testing::Values(0, 1, 2, 5));

TEST_P(ThreadPools, RunEveryTaskOnce) {
  ThreadPool pool(GetParam());
  for (const std::size_t count : {0, 1, 2, 100}) {
    std::vector<std::atomic<int>> done(count);
    pool.forAll(count, [&](std::size_t i) { ++done[i]; });
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(done[i], 1) << i << " of " << count;
  }
}

TEST_P(ThreadPools, BeginATaskWhenThoseFarEnoughBeforeItAreDone) {
  ThreadPool pool(GetParam());
  for (const std::size_t ahead : {1, 2, 4, 100}) {
    constexpr std::size_t kCount = 200;
    std::vector<std::atomic<int>> done(kCount);
    std::vector<char> too_early(kCount, 0);
    pool.inOrder(kCount, ahead, [&](std::size_t i) {
      for (std::size_t k = 0; k + ahead <= i; ++k) too_early[i] |= done[k] != 1;
      ++done[i];
    });
    for (std::size_t i = 0; i < kCount; ++i) {
      EXPECT_EQ(done[i], 1) << i << ", " << ahead << " ahead";
      EXPECT_FALSE(too_early[i]) << i << ", " << ahead << " ahead";
    }
  }
}

TEST_P(ThreadPools, PassOnWhatATaskThrows) {
  ThreadPool pool(GetParam());
  const auto fails = [](std::size_t i) {
    if (i == 7) throw std::runtime_error("the seventh");
  };
  EXPECT_THROW(pool.forAll(20, fails), std::runtime_error);
  EXPECT_THROW(pool.inOrder(20, 3, fails), std::runtime_error);
  std::atomic<int> done = 0;
  pool.inOrder(20, 3, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 20);
}

}  // namespace
}  // namespace carom
