#include "editing/search/parallel.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace carom {

void inParallel(int threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  if (threads == 1 || count < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, work, tbb::simple_partitioner()); });
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

}  // namespace carom
