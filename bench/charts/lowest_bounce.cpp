// SPDX-License-Identifier: MIT
// Where dice come to rest, against the height h_c below which a bounce is taken for the last one: the endless cascade is
// cut off there, and what it would have done with the friction of several corners is left out.

#include <algorithm>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart.h"
#include "bench/charts/die_scenes.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr int kDice = 100;
constexpr double kReference = 1e-14;  // m
constexpr double kSameFace = 0.1;     // rad, by which the same rest may be turned

struct Rest {
  bool known = false;
  BodyState state;
};

Rest restOf(const Scene& scene, double lowest_bounce) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = 100000;
  options.lowest_bounce = lowest_bounce;
  const Motion motion = simulate(scene, contacts, 60, options);
  if (motion.status != MotionStatus::complete) return {};
  return {true, motion.stateAt(0, motion.end)};
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

void measure(Csv& csv) {
  csv.note("place of rest of " + Cell(kDice).text + " dice of 16 mm, elasticity 0.5, friction 0.4, on a floor;");
  csv.note("m from where they rest with h_c = " + Cell(kReference).text + " m: median, and where a tenth are nearer, or farther");
  csv.note("same: share of dice that rest on the same face, which alone are counted");
  csv.columns({"lowest_bounce", "tenth", "median", "nine_tenths", "same"});
  Progress progress(kDice);
  const std::vector<double> heights = logSpaced(1e-12, 1e-5, 15);
  std::vector<std::vector<double>> off(heights.size());
  int known = 0;
  for (std::uint64_t seed = 1; seed <= kDice; ++seed) {
    progress.next("die " + Cell(static_cast<int>(seed)).text);
    const Scene scene = thrownDie(seed, 0.5, 0.4);
    const Rest best = restOf(scene, kReference);
    if (!best.known) continue;
    ++known;
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const Rest rest = restOf(scene, heights[i]);
      if (!rest.known || rest.state.orientation.angularDistance(best.state.orientation) > kSameFace) continue;
      off[i].push_back((rest.state.position - best.state.position).norm());
    }
  }
  for (std::size_t i = 0; i < heights.size(); ++i)
    csv.row({heights[i], quantile(off[i], 0.1), quantile(off[i], 0.5), quantile(off[i], 0.9),
             static_cast<double>(off[i].size()) / known});
}

}  // namespace carom::charts
