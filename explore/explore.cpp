// SPDX-License-Identifier: MIT
#include "explore/explore.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "adjoint/base/errors.h"
#include "editing/detail/parallel.hpp"

namespace carom {
namespace {

constexpr std::uint64_t kChunk = 256;         // in memory
constexpr std::uint64_t kStoredChunk = 1024;  // in a file

}  // namespace

WorldTable explore(const Exploration& exploration, std::uint64_t worlds, const ExploreRun& run) {
  if (worlds == 0) throw InputError("worlds", "found 0, expected 1 or more");
  if (run.threads < 0)
    throw InputError("threads", "found " + std::to_string(run.threads) + ", expected 0 (all cores) or more");
  WorldTable all = exploration.chunk(0, 0);
  const std::uint64_t size = run.chunk > 0 ? run.chunk : run.store ? kStoredChunk : kChunk;
  const std::uint64_t chunks = worlds / size + (worlds % size != 0);
  std::vector<std::optional<WorldTable>> parts(chunks);
  std::mutex mutex;
  ExploreProgress progress{0, worlds};
  editing_detail::ThreadPool pool(run.threads);
  pool.forAll(chunks, [&](std::size_t k) {
    if (run.stop.stop_requested()) return;
    const std::uint64_t first = k * size, count = std::min(size, worlds - first);
    std::optional<WorldTable> part = run.store ? run.store->read(first, count, all) : std::nullopt;
    const bool is_new = !part;
    if (is_new) part = exploration.chunk(first, count, run.stop);
    if (part->size() < count) return;  // stopped
    if (is_new && run.store) run.store->write(first, *part);
    const std::lock_guard lock(mutex);
    parts[k] = std::move(part);
    progress.done += count;
    if (run.progress) run.progress(progress);
  });
  for (std::optional<WorldTable>& part : parts) {
    if (part) all.append(*part);
    part.reset();
  }
  return all;
}

}  // namespace carom
