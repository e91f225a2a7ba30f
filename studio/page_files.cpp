// SPDX-License-Identifier: MIT
#include "studio/page_files.h"

#include <array>
#include <filesystem>
#include <utility>

#include "adjoint/base/errors.h"
#include "formats/base/read_file.hpp"

namespace carom::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNonce = "{{nonce}}";
constexpr std::size_t kLargestFile = 16u << 20;

constexpr std::array kThree = {"build/three.module.js",
                               "build/three.core.js",
                               "examples/jsm/controls/OrbitControls.js",
                               "examples/jsm/lines/Line2.js",
                               "examples/jsm/lines/LineGeometry.js",
                               "examples/jsm/lines/LineMaterial.js",
                               "examples/jsm/lines/LineSegments2.js",
                               "examples/jsm/lines/LineSegmentsGeometry.js"};

constexpr std::array kTypes = {std::pair{".html", "text/html; charset=utf-8"},
                               std::pair{".css", "text/css; charset=utf-8"},
                               std::pair{".js", "text/javascript; charset=utf-8"}, std::pair{".svg", "image/svg+xml"},
                               std::pair{".png", "image/png"}};

/// Null for files that are no part of the page.
const char* typeOf(const fs::path& file) {
  for (const auto& [extension, type] : kTypes)
    if (file.extension() == extension) return type;
  return nullptr;
}

PageFile readPageFile(const fs::path& path, const char* type) {
  return {formats_detail::readFile(path.string(), "a file of the page", kLargestFile), type};
}

bool isLeftOut(const fs::path& name) {
  return name == "node_modules" || name == "tests" || name.string().starts_with('.');
}

}  // namespace

bool PageFile::asksForNonce() const {
  return type.starts_with("text/html") && content.find(kNonce) != std::string::npos;
}

std::string PageFile::withNonce(const std::string& nonce) const {
  std::string text = content;
  for (std::size_t at = text.find(kNonce); at != std::string::npos; at = text.find(kNonce, at + nonce.size()))
    text.replace(at, kNonce.size(), nonce);
  return text;
}

PageFiles::PageFiles(const std::string& folder) {
  const fs::path root = folder;
  if (!fs::is_regular_file(root / "page/index.html"))
    throw InputError(folder, "found no page/index.html, expected the page of the studio");
  for (const char* name : kThree) {
    const fs::path file = root / "three" / name;
    if (!fs::is_regular_file(file))
      throw InputError("three.js is not installed (found no " + file.string() +
                       "): run scripts/setup studio in the sources of carom, install it again if it was installed from "
                       "there, and start carom studio again");
    add("/three/" + std::string(name), readPageFile(file, typeOf(file)));
  }
  const auto read = [&](const fs::path& from, const std::string& below) {
    if (!fs::is_directory(from)) return;
    const auto options = fs::directory_options::follow_directory_symlink;
    for (fs::recursive_directory_iterator entry(from, options), end; entry != end; ++entry) {
      if (isLeftOut(entry->path().filename())) {
        entry.disable_recursion_pending();
      } else if (const char* type = typeOf(entry->path()); type != nullptr && entry->is_regular_file()) {
        add(below + entry->path().lexically_relative(from).generic_string(), readPageFile(entry->path(), type));
      }
    }
  };
  read(root / "page", "/");
  read(root / "gallery", "/gallery/");
}

const PageFile* PageFiles::find(std::string_view path) const {
  const auto found = files_.find(path == "/" ? "/index.html" : path);
  return found == files_.end() ? nullptr : &found->second;
}

std::string studioFolder() {
  const fs::path executable = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& candidate : {executable / "../share/carom/studio", executable / "share/carom/studio"})
    if (fs::is_directory(candidate)) return candidate.lexically_normal().string();
  throw InputError("found no share/carom/studio beside " + executable.string() +
                   ", expected the page of the studio, which is installed with carom");
}

}  // namespace carom::studio
