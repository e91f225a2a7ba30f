// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace carom::studio {

/// The scenes that were opened last, in a file of one name a line. What cannot be read or written is no reason to fail.
class RecentFiles {
 public:
  /// `path` of that file; empty: nothing is kept.
  explicit RecentFiles(std::string path) : path_(std::move(path)) {}

  /// This one was opened, or saved under that name. `file` is absolute.
  void add(const std::string& file) const;
  /// Those below a folder that are still there, the last one first, as names in it.
  std::vector<std::string> below(const std::string& folder) const;

 private:
  std::string path_;
};

/// Where programs of this user keep what they remember: $XDG_STATE_HOME, or .local/state at home; empty: nowhere.
std::string recentFilesPath();

}  // namespace carom::studio
