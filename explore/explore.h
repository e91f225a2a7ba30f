// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

#include "explore/store/world_store.h"
#include "explore/worlds/exploration.h"
#include "explore/worlds/world_table.h"

namespace carom {

/// How far an exploration is.
struct ExploreProgress {
  std::uint64_t done = 0;    ///< worlds, those of a store included
  std::uint64_t worlds = 0;  ///< of all
};

/// How worlds are computed; nothing of it affects the table.
struct ExploreRun {
  int threads = 0;  ///< 0: all cores
  std::uint64_t chunk =
      0;  ///< worlds that a thread computes at a time, and that a file of a store has; 0: as many as suit
  /// Called after every chunk, by one thread at a time, not always the same.
  std::function<void(const ExploreProgress&)> progress = {};
  std::stop_token stop = {};    ///< once requested, the table has the chunks that are complete, in order, and no more
  WorldStore* store = nullptr;  ///< chunks that it has are read, others kept in it
};

/// Worlds 0 to worlds - 1, on all cores. Throws InputError for no worlds, and what a store throws.
WorldTable explore(const Exploration& exploration, std::uint64_t worlds, const ExploreRun& run = {});

}  // namespace carom
