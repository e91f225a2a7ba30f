// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "explore/worlds/world_table.h"

namespace carom {

/// Finished chunks of worlds in a folder, from which a run that was killed goes on. Each is a file (tableBytes) that is
/// there as a whole or not at all; the file "question" says what they are of. Safe in several threads and processes.
class WorldStore {
 public:
  /// A folder within `folder`, named by a hash of the question (see questionOf), made where it is not there. Throws
  /// InputError: it cannot be written, or has the worlds of another question.
  WorldStore(const std::string& folder, const std::string& question);

  /// Worlds first to first + count - 1, if they are there, undamaged, and of the widths of `like`.
  std::optional<WorldTable> read(std::uint64_t first, std::uint64_t count, const WorldTable& like) const;
  /// Keeps the worlds from `first` on. Throws InputError where that cannot be written.
  void write(std::uint64_t first, const WorldTable& table) const;
  const std::string& folder() const { return folder_; }  ///< of this question

 private:
  std::string fileOf(std::uint64_t first, std::uint64_t count) const;
  std::string folder_;
};

}  // namespace carom
