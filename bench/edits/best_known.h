// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "bench/edits/tasks.h"

namespace carom::bench {

/// The smallest change that is known for each task, kept in a file beside the tasks. An entry counts only for the very
/// task it was found for: the change of its hidden throw is kept with it.
class BestKnown {
 public:
  /// A file that is not there is an empty one. Throws std::runtime_error for one that cannot be understood.
  explicit BestKnown(std::string file);

  /// Objective; the hidden throw's own where nothing smaller is known.
  double of(const Task& task) const;
  /// Keeps `objective` if it is smaller than what is known.
  void offer(const Task& task, double objective, const std::string& found_by);
  /// Writes the file, with what others have written there in the meantime where that is smaller.
  void save();

 private:
  struct Entry {
    double hidden = 0, objective = 0;
    std::string found_by;
  };
  const Entry* entryOf(const Task& task) const;

  void read();

  std::string file_;
  std::map<std::pair<std::uint64_t, int>, Entry> entries_;  ///< by seed and index
};

}  // namespace carom::bench
