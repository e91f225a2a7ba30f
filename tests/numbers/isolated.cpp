// SPDX-License-Identifier: MIT
#include "tests/numbers/isolated.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace carom::test {
namespace {

double cpuSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void limitCpu(unsigned seconds) {
  rlimit limit{};
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = static_cast<rlim_t>(cpuSeconds()) + seconds + 1;
  setrlimit(RLIMIT_CPU, &limit);
}

std::string onOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// In the child. What it came to stands in a file, so that it outlives the process: "begin 3", "end 3 0.12 what".
[[noreturn]] void runFrom(std::size_t first, std::size_t count, const std::function<std::string(std::size_t)>& run,
                          unsigned seconds, const std::string& log) {
  std::ofstream out(log, std::ios::app);
  const rlimit none{};
  setrlimit(RLIMIT_CORE, &none);
  for (std::size_t i = first; i < count; ++i) {
    out << "begin " << i << std::endl;
    limitCpu(seconds);
    const double began = cpuSeconds();
    std::string what;
    try {
      what = run(i);
    } catch (const std::exception& error) {
      what = std::string("threw ") + error.what();
    } catch (...) {
      what = "threw something that is no std::exception";
    }
    out << "end " << i << ' ' << cpuSeconds() - began << ' ' << onOneLine(what) << std::endl;
  }
  out.close();
  _exit(0);
}

std::string describeEnd(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return "used too much time";
  if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
  return "ended the process with " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

std::vector<CaseFailure> runIsolated(std::size_t count, const std::function<std::string(std::size_t)>& run,
                                     unsigned cpu_seconds, double* longest) {
  std::vector<CaseFailure> failures;
  const std::string log = testing::TempDir() + "carom-cases-" + std::to_string(getpid());
  std::size_t next = 0;
  while (next < count) {
    std::ofstream(log, std::ios::trunc);
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) runFrom(next, count, run, cpu_seconds, log);
    int status = 0;
    waitpid(child, &status, 0);
    std::ifstream lines(log);
    std::size_t begun = next, ended = next;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string word, what;
      std::size_t index = 0;
      double seconds = 0;
      words >> word >> index;
      if (word == "begin") begun = index + 1;
      if (word != "end") continue;
      ended = index + 1;
      words >> seconds;
      std::getline(words >> std::ws, what);
      if (longest) *longest = std::max(*longest, seconds);
      if (!what.empty()) failures.push_back({index, what});
    }
    if (begun > ended) failures.push_back({begun - 1, describeEnd(status)});
    if (begun == next && ended == next) {
      failures.push_back({next, "its process could not begin: " + describeEnd(status)});
      begun = next + 1;
    }
    next = std::max(begun, ended);
  }
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  return failures;
}

}  // namespace carom::test
