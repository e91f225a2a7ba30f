// SPDX-License-Identifier: MIT
#include "editing/detail/parallel.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <optional>
#include <thread>
#include <vector>

namespace carom::editing_detail {
namespace {

#if defined(__SANITIZE_THREAD__)

/// Debian's oneTBB is not instrumented, so that ThreadSanitizer takes its tasks, and all that they hand on, for races.
/// Under it plain threads run the same work.
void runAll(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> crew;
  for (int t = 0; t < (threads > 0 ? threads : 2); ++t)
    crew.emplace_back([&] {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    });
}

#else

void runAll(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  // More threads than cores are for those who ask for them; without this oneTBB warns and ignores the request.
  std::optional<tbb::global_control> more;
  if (threads > tbb::info::default_concurrency())
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, work, tbb::simple_partitioner()); });
}

#endif

}  // namespace

void inParallel(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  if (threads == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  runAll(threads, count, work);
}

ContactSource* ContactPool::take() {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) {
    made_.push_back(first_.another());
    return made_.back().get();
  }
  ContactSource* source = free_.back();
  free_.pop_back();
  return source;
}

void ContactPool::give(ContactSource* source) {
  const std::lock_guard lock(mutex_);
  free_.push_back(source);
}

}  // namespace carom::editing_detail
