// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace carom::studio {

/// A folder for one test, gone with it.
class TestFolder {
 public:
  TestFolder() {
    std::random_device random;
    path_ = std::filesystem::temp_directory_path() /
            ("carom-studio-" + std::to_string(random()) + std::to_string(random()));
    std::filesystem::create_directories(path_);
    path_ = std::filesystem::canonical(path_);
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
  }
  std::string read(const std::string& name) const {
    std::ifstream in(path_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void remove(const std::string& name) const { std::filesystem::remove_all(path_ / name); }

 private:
  std::filesystem::path path_;
};

/// One with all that the server of the studio needs of its page, which does nothing.
class ShareFolder : public TestFolder {
 public:
  static constexpr const char* kIndex =
      "<!doctype html><title>carom</title><script nonce=\"{{nonce}}\"></script><style nonce=\"{{nonce}}\"></style>";

  ShareFolder() {
    write("page/index.html", kIndex);
    write("page/main.js", "// {{nonce}} is left alone here");
    for (const char* name :
         {"build/three.module.js", "build/three.core.js", "examples/jsm/controls/OrbitControls.js",
          "examples/jsm/lines/Line2.js", "examples/jsm/lines/LineGeometry.js", "examples/jsm/lines/LineMaterial.js",
          "examples/jsm/lines/LineSegments2.js", "examples/jsm/lines/LineSegmentsGeometry.js"})
      write(std::string("three/") + name, "export {};");
  }
};

}  // namespace carom::studio
