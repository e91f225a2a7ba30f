// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "studio/page_files.h"

namespace carom::studio {

/// The texts of a page, compressed by a thread of their own: a page that is asked for before that gets them as they are.
class CompressedFiles {
 public:
  /// Keeps `files` by reference.
  explicit CompressedFiles(const PageFiles& files);

  /// The gzip file (RFC 1952) of exactly this address; null: not yet, or it is not worth it. Valid as long as this. From any thread.
  const std::string* find(std::string_view path) const;
  /// Waits until all are there.
  void wait();

 private:
  void compressAll(const PageFiles& files, const std::stop_token& stop);

  mutable std::mutex mutex_;
  std::map<std::string, std::string, std::less<>> files_;
  std::jthread thread_;  // last, as it uses the others
};

/// Whether one of these values of the field Accept-Encoding takes gzip.
bool acceptsGzip(const std::vector<std::string>& values);

}  // namespace carom::studio
