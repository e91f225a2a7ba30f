// SPDX-License-Identifier: MIT
// Impacts per second and memory per impact against the number of bodies: equal balls in a pen, tumbling boxes, mugs.
//   scale_bench --benchmark_min_time=1
//   scale_bench --machine               prints what it would be measured on
// bench/charts/scale.measure runs it for the chart.

#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "bench/machine.h"
#include "bench/pen.h"
#include "examples/support/project_file.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {
namespace {

struct Case {
  std::string name;
  std::function<Scene()> make;
  std::size_t impacts;
  bool record_events;
};

std::vector<Case> allCases() {
  std::vector<Case> cases;
  for (int n : {10, 100, 1000, 10000}) {
    const std::size_t impacts = static_cast<std::size_t>(std::max(20000, 20 * n));
    const auto make = [n] { return penOfBalls(n, 1); };
    cases.push_back({"balls/" + std::to_string(n), make, impacts, true});
    cases.push_back({"balls_paths_only/" + std::to_string(n), make, impacts, false});
  }
  cases.push_back({"boxes/200", [] { return penOfBoxes(200, 1); }, 4000, true});
  cases.push_back({"mugs/8", [] { return penOfMugs(8, projectFile("examples/assets/mug.obj"), 1); }, 200, true});
  return cases;
}

Motion play(const Case& c, const Scene& scene, OdeContacts& contacts) {
  constexpr double kForever = 1e6;  // s
  SimulateOptions options;
  options.impact_limit = c.impacts;
  options.record_events = c.record_events;
  return simulate(scene, contacts, kForever, options);
}

long peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024;
}

// Growth of the peak resident memory over one simulation, per impact.
int printBytesPerImpact(const Case& c) {
  const Scene scene = c.make();
  OdeContacts contacts(scene);
  const long before = peakBytes();
  const Motion motion = play(c, scene, contacts);
  std::printf("%.1f\n", static_cast<double>(peakBytes() - before) / static_cast<double>(motion.impacts));
  return 0;
}

// The same from a fresh process: a peak never comes down again, and freed memory is used again.
double bytesPerImpact(std::size_t number) {
  char self[4096];
  const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
  if (length <= 0) return 0;
  const std::string command =
      "'" + std::string(self, static_cast<std::size_t>(length)) + "' --bytes " + std::to_string(number);
  FILE* answer = popen(command.c_str(), "r");
  if (!answer) return 0;
  double bytes = 0;
  const bool read = std::fscanf(answer, "%lf", &bytes) == 1;
  return pclose(answer) == 0 && read ? bytes : 0;
}

void measure(benchmark::State& state, const Case& c, std::size_t number) {
  const Scene scene = c.make();
  OdeContacts contacts(scene);
  state.counters["bodies"] = static_cast<double>(movingBodies(scene));
  state.counters["bytes_per_impact"] = bytesPerImpact(number);
  std::size_t done = 0;
  for (auto _ : state) {
    const Motion motion = play(c, scene, contacts);
    done += motion.impacts;
    benchmark::DoNotOptimize(motion.end);
  }
  state.counters["impacts_per_second"] = benchmark::Counter(static_cast<double>(done), benchmark::Counter::kIsRate);
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  using namespace carom;
  const std::vector<Case> cases = allCases();
  if (argc == 2 && std::string(argv[1]) == "--machine") {
    std::printf("%s\n", machineLine().c_str());
    return 0;
  }
  if (argc == 3 && std::string(argv[1]) == "--bytes")
    return printBytesPerImpact(cases.at(static_cast<std::size_t>(std::atoi(argv[2]))));
  for (std::size_t i = 0; i < cases.size(); ++i)
    benchmark::RegisterBenchmark(cases[i].name.c_str(), [&cases, i](benchmark::State& state) {
      try {
        measure(state, cases[i], i);
      } catch (const InputError& error) {
        state.SkipWithError(error.what());
      }
    })->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
