// SPDX-License-Identifier: MIT
#include "studio/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

#include "formats/base/write_file.hpp"

namespace carom::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kKept = 100, kShown = 8;

std::vector<std::string> linesOf(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream in(path);
  for (std::string line; lines.size() < kKept && std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace

void RecentFiles::add(const std::string& file) const {
  if (path_.empty() || file.find('\n') != std::string::npos) return;
  std::vector<std::string> lines = linesOf(path_);
  std::erase(lines, file);
  lines.insert(lines.begin(), file);
  if (lines.size() > kKept) lines.pop_back();
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  try {
    fs::create_directories(fs::path(path_).parent_path());
    formats_detail::writeFile(path_, text);
  } catch (const std::exception&) {  // a home that cannot be written remembers nothing
  }
}

std::vector<std::string> RecentFiles::below(const std::string& folder) const {
  std::vector<std::string> names;
  for (const std::string& line : path_.empty() ? std::vector<std::string>() : linesOf(path_)) {
    const fs::path name = fs::path(line).lexically_relative(folder);
    std::error_code error;
    const bool is_below = !name.empty() && *name.begin() != "..";
    if (is_below && fs::is_regular_file(line, error) && names.size() < kShown) names.push_back(name.generic_string());
  }
  return names;
}

std::string recentFilesPath() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state != nullptr && *state == '/') return std::string(state) + "/carom/opened";
  return home != nullptr && *home == '/' ? std::string(home) + "/.local/state/carom/opened" : "";
}

}  // namespace carom::studio
