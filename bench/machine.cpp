// SPDX-License-Identifier: MIT
#include "bench/machine.h"

#include <Eigen/Core>
#include <ctime>
#include <fstream>
#include <thread>

#include "carom/version.h"

namespace carom {
namespace {

std::string today() {
  const std::time_t time = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&time));
  return text;
}

#ifdef __clang__
constexpr const char* kCompiler = "clang " __clang_version__;
#else
constexpr const char* kCompiler = "g++ " __VERSION__;
#endif

}  // namespace

std::string machineLine() {
  std::ifstream info("/proc/cpuinfo");
  std::string line, processor = "unknown processor";
  while (std::getline(info, line)) {
    if (!line.starts_with("model name")) continue;
    processor = line.substr(line.find(':') + 2);
    break;
  }
  return processor + "; " + std::to_string(std::thread::hardware_concurrency()) + " cores; " + kCompiler +
         "; Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION) + "; ODE " CAROM_BENCH_ODE "; Ipopt " CAROM_BENCH_IPOPT "; carom " +
         kVersion + "; " + today();
}

}  // namespace carom
