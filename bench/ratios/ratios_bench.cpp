// SPDX-License-Identifier: MIT
// Ratios of times that were measured side by side, and counts of work, against their limits: fails where one is above
// its own. A limit stands a quarter above what was measured when it was set, so that noise does not reach it and a
// slow-down of 1.5 does; a count may not grow, but of iterations by a quarter.
//   ratios_bench LIMITS                  checks, and prints every ratio with its limit
//   ratios_bench LIMITS WORDS            those alone with these words in their names
//   ratios_bench --set LIMITS            writes the limits anew from what it measures
// Times are those of the processor in this thread, the least of interleaved repetitions. What is above its limit is
// measured on, up to five times as long: other work on the machine can only add to either time.

#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "bench/ratios/workloads.h"

namespace carom::bench {
namespace {

constexpr double kHeadroom = 1.25;
constexpr int kMoreTimes = 5;
constexpr double kMostOfAdjoint = 1.5;  // simulations for an adjoint row, with whatever headroom that leaves

double processorSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double secondsOf(const std::function<void()>& run, int calls) {
  const double before = processorSeconds();
  for (int i = 0; i < calls; ++i) run();
  return (processorSeconds() - before) / calls;
}

// So many calls that the clock is fine enough; the first call of all warms up.
int callsFor(const std::function<void()>& run) {
  constexpr double kBatch = 5e-4;  // s
  run();
  return std::max(1, static_cast<int>(std::ceil(kBatch / std::max(1e-9, secondsOf(run, 1)))));
}

// The least times so far: more rounds bring both nearer to what they are without other work on the machine.
class Stopwatch {
 public:
  explicit Stopwatch(const Ratio& ratio)
      : ratio_(ratio), calls_(callsFor(ratio.run)), unit_calls_(callsFor(ratio.unit)) {}

  double measure() {
    constexpr int kLeastRounds = 8, kMostRounds = 60;
    constexpr double kSeconds = 0.2;
    const double began = processorSeconds();
    for (int i = 0; i < kMostRounds && (i < kLeastRounds || processorSeconds() - began < kSeconds); ++i) {
      unit_ = std::min(unit_, secondsOf(ratio_.unit, unit_calls_));
      run_ = std::min(run_, secondsOf(ratio_.run, calls_));
    }
    return run_ / unit_ / ratio_.parts;
  }

 private:
  const Ratio& ratio_;
  int calls_, unit_calls_;
  double run_ = std::numeric_limits<double>::infinity(), unit_ = run_;
};

// Lines "1.23 words"; '#' begins a comment.
std::map<std::string, double> readLimits(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::map<std::string, double> limits;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    double limit = 0;
    std::string name;
    if (line.empty() || line[0] == '#') continue;
    if (!(words >> limit) || !std::getline(words >> std::ws, name))
      throw std::runtime_error(path + ": found '" + line + "', expected a number and what it limits");
    limits[name] = limit;
  }
  return limits;
}

bool isAdjoint(const std::string& name) { return name.starts_with("adjoint row"); }

int check(const std::string& path, const std::string& words) {
  const std::map<std::string, double> limits = readLimits(path);
  const Workloads all = workloads();
  int failures = 0;
  std::size_t known = 0;
  const auto judge = [&](const std::string& name, double number, double limit) {
    const bool holds = number <= limit;
    std::printf("%-45s %10.4g of %10.4g%s\n", name.c_str(), number, limit, holds ? "" : "  TOO MUCH");
    failures += !holds;
  };
  const auto limitOf = [&](const std::string& name) {
    const auto found = limits.find(name);
    if (found == limits.end()) throw std::runtime_error(path + " has no limit of: " + name);
    ++known;
    return found->second;
  };
  const auto chosen = [&](const std::string& name) { return name.find(words) != std::string::npos; };
  for (const Ratio& ratio : all.ratios) {
    const double limit = limitOf(ratio.name);
    if (!chosen(ratio.name)) continue;
    Stopwatch watch(ratio);
    double number = watch.measure();
    for (int again = 0; again < kMoreTimes && !(number <= limit); ++again) number = watch.measure();
    judge(ratio.name, number, limit);
  }
  for (const Count& count : all.counts) {
    const double limit = limitOf(count.name);
    if (chosen(count.name)) judge(count.name, count.number, limit);
  }
  if (known < limits.size()) throw std::runtime_error(path + " limits what is not measured any more");
  if (failures > 0) std::fprintf(stderr, "ratios: %d of %zu are above their limits\n", failures, limits.size());
  return failures > 0;
}

int set(const std::string& path) {
  const Workloads all = workloads();
  std::ofstream out(path);
  out << "# Most that each may be, see ratios_bench.cpp, which writes this file: ratios_bench --set\n";
  const auto line = [&](double limit, const std::string& name) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g ", limit);
    out << text << name << '\n';
  };
  for (const Ratio& ratio : all.ratios) {
    Stopwatch watch(ratio);
    double number = watch.measure();
    for (int again = 0; again < kMoreTimes; ++again) number = watch.measure();
    const double limit = kHeadroom * number;
    const bool promised = isAdjoint(ratio.name) && number < kMostOfAdjoint / 1.15;
    line(promised ? std::min(kMostOfAdjoint, limit) : limit, ratio.name);
  }
  // roundings move how many iterations there are
  for (const Count& count : all.counts)
    line(count.name.starts_with("iterations") ? std::ceil(kHeadroom * count.number) : count.number, count.name);
  return out.flush() ? 0 : 1;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  try {
    if (argc == 3 && std::string(argv[1]) == "--set") return carom::bench::set(argv[2]);
    if (argc == 2 || argc == 3) return carom::bench::check(argv[1], argc == 3 ? argv[2] : "");
    std::fprintf(stderr, "usage: ratios_bench LIMITS [WORDS], or ratios_bench --set LIMITS\n");
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ratios_bench: %s\n", error.what());
    return 2;
  }
}
