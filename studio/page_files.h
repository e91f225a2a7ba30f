// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace carom::studio {

/// A file of the page.
struct PageFile {
  std::string content;  ///< the whole of it
  std::string type;     ///< of the media: "text/javascript; charset=utf-8"
  /// The content with a nonce in all places that ask for one (`{{nonce}}`, in HTML alone).
  std::string withNonce(const std::string& nonce) const;
  bool asksForNonce() const;  ///< there is such a place
};

/// The page and what it uses of three.js, read into memory once: no address ever reaches the disk.
class PageFiles {
 public:
  PageFiles() = default;
  /// Of a folder with `page/`, `three/` (the package as npm installs it) and, where it is there, `gallery/` with
  /// pictures. Throws InputError for a folder without them, and says what to run where three.js is missing.
  explicit PageFiles(const std::string& folder);

  /// The file of exactly this address ("/main.js"; "/" is index.html); null: none. Valid as long as this.
  const PageFile* find(std::string_view path) const;
  const std::map<std::string, PageFile, std::less<>>& all() const { return files_; }  ///< by address
  /// Adds a file, for tests.
  void add(const std::string& path, PageFile file) { files_[path] = std::move(file); }

 private:
  std::map<std::string, PageFile, std::less<>> files_;
};

/// The folder of the page and its examples, from where the executable is: share/carom/studio beside its folder or in
/// it. Throws InputError where there is none.
std::string studioFolder();

}  // namespace carom::studio
