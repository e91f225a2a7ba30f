// SPDX-License-Identifier: MIT
#include "editing/detail/parallel.hpp"

#include <algorithm>

#if defined(__SANITIZE_THREAD__)
#include <condition_variable>
#include <exception>
#else
#include <optional>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace carom::editing_detail {

#if defined(__SANITIZE_THREAD__)

/// Debian's oneTBB is not instrumented, so that ThreadSanitizer takes its tasks, and all that they hand on, for races.
/// Under it plain threads run the same work.
struct ThreadPool::Threads {
  explicit Threads(int threads) : count(threads > 0 ? threads : 2) {}

  void forAll(std::size_t n, const std::function<void(std::size_t)>& work) { inOrder(n, n, work); }
  void inOrder(std::size_t n, std::size_t ahead, const std::function<void(std::size_t)>& work) {
    std::mutex mutex;
    std::condition_variable changed;
    std::exception_ptr thrown;
    std::vector<char> done(n, 0);
    std::size_t next = 0, ended = 0;  // all before `ended` are done
    const auto each = [&] {
      for (std::unique_lock lock(mutex); next < n && !thrown;) {
        const std::size_t i = next++;
        changed.wait(lock, [&] { return i < ended + ahead || thrown; });
        if (thrown) return;
        lock.unlock();
        std::exception_ptr failure;
        try {
          work(i);
        } catch (...) {
          failure = std::current_exception();
        }
        lock.lock();
        if (!thrown) thrown = failure;
        done[i] = 1;
        while (ended < n && done[ended]) ++ended;
        changed.notify_all();
      }
    };
    {
      std::vector<std::jthread> pool;
      for (int t = 0; t < count; ++t) pool.emplace_back(each);
    }
    if (thrown) std::rethrow_exception(thrown);
  }

  int count;
};

#else

struct ThreadPool::Threads {
  explicit Threads(int threads) : arena(threads > 0 ? threads : tbb::task_arena::automatic) {
    // More threads than cores are for those who ask for them; without this oneTBB warns and ignores the request.
    if (threads > tbb::info::default_concurrency())
      more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }

  void forAll(std::size_t n, const std::function<void(std::size_t)>& work) {
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, n, work, tbb::simple_partitioner()); });
  }
  void inOrder(std::size_t n, std::size_t ahead, const std::function<void(std::size_t)>& work) {
    std::size_t next = 0;
    const auto begin = tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
      if (next == n) flow.stop();
      return next++;
    });
    const auto middle = tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, [&](std::size_t i) {
      work(i);
      return i;
    });
    const auto end = tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, [](std::size_t) {});
    arena.execute([&] { tbb::parallel_pipeline(ahead, begin & middle & end); });
  }

  std::optional<tbb::global_control> more;
  tbb::task_arena arena;
};

#endif

ThreadPool::ThreadPool(int threads) {
  if (threads != 1) threads_ = std::make_unique<Threads>(threads);
}

ThreadPool::~ThreadPool() = default;

void ThreadPool::forAll(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (threads_ && count > 1) return threads_->forAll(count, work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

void ThreadPool::inOrder(std::size_t count, std::size_t ahead, const std::function<void(std::size_t)>& work) {
  if (threads_ && count > 1 && ahead > 1) return threads_->inOrder(count, ahead, work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

ContactSource* ContactPool::take() {
  const std::lock_guard lock(mutex_);
  if (free_.empty()) {
    made_.push_back(first_.another());
    return made_.back().get();
  }
  auto lent = std::ranges::find(free_, std::this_thread::get_id(), &Free::last_lent_to);
  if (lent == free_.end()) lent = free_.end() - 1;
  ContactSource* source = lent->source;
  free_.erase(lent);
  return source;
}

void ContactPool::give(ContactSource* source) {
  const std::lock_guard lock(mutex_);
  free_.push_back({source, std::this_thread::get_id()});
}

}  // namespace carom::editing_detail
