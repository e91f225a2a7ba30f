#include "bench/machine.h"

#include <Eigen/Core>
#include <fstream>
#include <thread>

#include "carom/version.h"

namespace carom {

std::string machineLine() {
  std::ifstream info("/proc/cpuinfo");
  std::string line, processor = "unknown processor";
  while (std::getline(info, line)) {
    if (!line.starts_with("model name")) continue;
    processor = line.substr(line.find(':') + 2);
    break;
  }
  return processor + "; " + std::to_string(std::thread::hardware_concurrency()) + " cores; g++ " + __VERSION__ +
         "; Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION) + "; carom " + kVersion;
}

}  // namespace carom
