// Impacts per second and memory per impact against the number of bodies: equal balls in a pen, tumbling boxes, a mug.
//   carom_scale_bench --benchmark_min_time=1 --benchmark_out=scale.csv --benchmark_out_format=csv
// bench/plot_scale runs it and draws the chart.

#include <benchmark/benchmark.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <string>

#include "adjoint/errors.h"
#include "adjoint/simulate.h"
#include "bench/pen.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {
namespace {

constexpr double kForever = 1e6;  // s

Motion play(const Scene& scene, OdeContacts& contacts, std::size_t impacts, bool record_events) {
  SimulateOptions options;
  options.impact_limit = impacts;
  options.record_events = record_events;
  return simulate(scene, contacts, kForever, options);
}

long peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024;
}

// Growth of the peak resident memory over a simulation, in a process of its own: a peak never comes down again.
double bytesPerImpact(const Scene& scene, std::size_t impacts, bool record_events) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    OdeContacts contacts(scene);
    const long before = peakBytes();
    const Motion motion = play(scene, contacts, impacts, record_events);
    const double grown = static_cast<double>(peakBytes() - before) / static_cast<double>(motion.impacts);
    const bool written = write(ends[1], &grown, sizeof grown) == sizeof grown;
    _exit(written ? 0 : 1);
  }
  double grown = 0;
  close(ends[1]);
  if (child < 0 || read(ends[0], &grown, sizeof grown) != sizeof grown) grown = 0;
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return grown;
}

void simulateScene(benchmark::State& state, const Scene& scene, std::size_t impacts, bool record_events) {
  OdeContacts contacts(scene);
  state.counters["bytes_per_impact"] = bytesPerImpact(scene, impacts, record_events);
  std::size_t done = 0;
  for (auto _ : state) {
    const Motion motion = play(scene, contacts, impacts, record_events);
    done += motion.impacts;
    benchmark::DoNotOptimize(motion.end);
  }
  state.counters["bodies"] = static_cast<double>(movingBodies(scene));
  state.counters["impacts_per_second"] = benchmark::Counter(static_cast<double>(done), benchmark::Counter::kIsRate);
}

void add(const std::string& name, const std::function<Scene()>& make, std::size_t impacts, bool record_events) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    try {
      simulateScene(state, make(), impacts, record_events);
    } catch (const InputError& error) {
      state.SkipWithError(error.what());
    }
  })->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  using namespace carom;
  for (int n : {10, 100, 1000, 10000}) {
    const std::size_t impacts = static_cast<std::size_t>(std::max(20000, 20 * n));
    const auto make = [n] { return penOfBalls(n, 1); };
    add("balls/" + std::to_string(n), make, impacts, true);
    add("balls_paths_only/" + std::to_string(n), make, impacts, false);
  }
  add(
      "boxes/200", [] { return penOfBoxes(200, 1); }, 4000, true);
  add(
      "mugs/8", [] { return penOfMugs(8, CAROM_ASSETS_DIR "/mug.obj", 1); }, 200, true);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
