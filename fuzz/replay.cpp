// SPDX-License-Identifier: MIT
// Runs one target on files, without libFuzzer: what it has found stays found, and a finding can be followed in any
// debugger. A folder stands for its files.
//   fuzz_replay scene fuzz/corpus/scene
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/base/read_file.hpp"
#include "fuzz/targets.h"

namespace {

namespace fs = std::filesystem;

std::vector<std::string> filesOf(const std::string& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) try {
  const carom::fuzz::Target* target = argc < 3 ? nullptr : carom::fuzz::targetNamed(argv[1]);
  if (target == nullptr) {
    std::fprintf(stderr, "usage: fuzz_replay scene|obj|gltf|protocol <file or folder>...\n");
    return 2;
  }
  std::size_t count = 0;
  for (int i = 2; i < argc; ++i)
    for (const std::string& file : filesOf(argv[i])) {
      std::fprintf(stderr, "%s\n", file.c_str());  // the last line names the file that ends the process
      constexpr std::size_t kLimit = 1 << 24;      // bytes
      target->run(carom::formats_detail::readFile(file, "a file of a corpus", kLimit));
      ++count;
    }
  std::printf("%s: %zu files\n", target->name, count);
  return count > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "fuzz_replay: %s\n", error.what());
  return 1;
}
