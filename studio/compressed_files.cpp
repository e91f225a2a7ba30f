// SPDX-License-Identifier: MIT
#include "studio/compressed_files.h"

#include <algorithm>
#include <utility>

#include "studio/deflate.h"

namespace carom::studio {
namespace {

/// Bytes from which on it is worth it.
constexpr std::size_t kSmallestWorth = 1024;
/// Nine tenths of the gain of the smallest for a third of the time.
constexpr int kQuickLevel = 5;

bool isText(const PageFile& file) { return !file.type.starts_with("image/png"); }

}  // namespace

CompressedFiles::CompressedFiles(const PageFiles& files)
    : thread_([this, &files](const std::stop_token& stop) { compressAll(files, stop); }) {}

void CompressedFiles::compressAll(const PageFiles& files, const std::stop_token& stop) {
  for (const auto& [path, file] : files.all()) {
    if (stop.stop_requested()) return;
    if (!isText(file) || file.asksForNonce() || file.content.size() < kSmallestWorth) continue;
    std::string bytes = gzipped(file.content, kQuickLevel);
    const std::lock_guard lock(mutex_);
    files_[path] = std::move(bytes);
  }
}

const std::string* CompressedFiles::find(std::string_view path) const {
  const std::lock_guard lock(mutex_);
  const auto found = files_.find(path);
  return found == files_.end() ? nullptr : &found->second;  // nodes of a map stay where they are
}

void CompressedFiles::wait() {
  if (thread_.joinable()) thread_.join();
}

bool acceptsGzip(const std::vector<std::string>& values) {
  for (std::string value : values) {
    std::erase(value, ' ');
    for (std::size_t begin = 0; begin <= value.size();) {
      const std::size_t end = std::min(value.find(',', begin), value.size());
      const std::string_view one = std::string_view(value).substr(begin, end - begin), name = one.substr(0, one.find(';'));
      const std::string_view quality = one.substr(name.size());
      if ((name == "gzip" || name == "*") && !(quality.starts_with(";q=0") && quality.find_first_not_of("0.", 3) == std::string_view::npos)) return true;
      begin = end + 1;
    }
  }
  return false;
}

}  // namespace carom::studio
