// SPDX-License-Identifier: MIT
// 500 dice that come to rest: the time of one, of the gradient of its place of rest, and where the time goes: searching
// for what comes next, impacts, and paths that corners hold. The parts are measured by doing them once more.

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/impact/impact.hpp"
#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart.h"
#include "bench/charts/die_scenes.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

using adjoint_detail::ConstrainedPath;

constexpr int kDice = 500;
constexpr double kAsked = 60;  // s; a die rests long before
constexpr double kBudget = 0.02;

Motion played(const Scene& scene, OdeContacts& contacts) {
  SimulateOptions options;
  options.impact_limit = 100000;
  return simulate(scene, contacts, kAsked, options);
}

struct Counts {
  int impacts = 0, paths = 0, steps = 0;
};

Counts countsOf(const Motion& motion) {
  Counts counts;
  for (const Event& event : motion.events) counts.impacts += event.kind != EventKind::transition;
  for (const Arc& arc : motion.world_lines[0].arcs)
    if (const auto* path = arc.trajectory().constrained())
      ++counts.paths, counts.steps += static_cast<int>(path->steps());
  return counts;
}

// All impacts of a motion once more.
void impactsAgain(const Motion& motion) {
  std::vector<State> after;
  for (const Event& event : motion.events) {
    if (event.kind == EventKind::transition) continue;
    Event again = event;
    adjoint_detail::solveImpact(again, *motion.models, after);
  }
}

// All its paths once more, as far as they are known.
void pathsAgain(const Motion& motion) {
  for (const Arc& arc : motion.world_lines[0].arcs) {
    const auto* path = arc.trajectory().constrained();
    if (!path) continue;
    ConstrainedPath again(path->scene(), path->contacts(), path->redundant(), path->guards(), path->stateAt(path->start()),
                   path->start(), motion.duration);
    again.extendTo(path->knownUntil());
  }
}

// Of the place of rest, x and y, by every number of the scene.
double gradientSeconds(const Motion& motion) {
  StateSeed seed;
  seed.body = 0, seed.at = Instant::at(motion.end), seed.position = Vec3(1, 0.3, 0);
  return bestSeconds([&] { adjoint(motion, std::span(&seed, 1)); }, kBudget, 5);
}

}  // namespace

void measure(Csv& csv) {
  csv.note("elasticity 0, 0.2, 0.5 or 0.85, friction 0.1, 0.4 or 1; seconds: the least of some runs");
  csv.note("gradient: of one row, tape and all, by every number; nan: refused, with a sentence");
  csv.note("impacts, paths: all of them done once more; what is left is searching for what comes next, and the rest");
  csv.columns({"seed", "seconds", "gradient_seconds", "impact_seconds", "path_seconds", "impacts", "paths", "steps"});
  Progress progress(kDice);
  for (std::uint64_t seed = 1; seed <= kDice; ++seed) {
    progress.next("die " + Cell(static_cast<int>(seed)).text);
    const Scene scene = anyDie(seed);
    OdeContacts contacts(scene);
    const Motion motion = played(scene, contacts);
    const Counts counts = countsOf(motion);
    const double seconds = bestSeconds([&] { played(scene, contacts); }, kBudget, 5);
    double gradient = NAN;
    try {
      gradient = gradientSeconds(motion);
    } catch (const NotComputable&) {
    }
    csv.row({static_cast<int>(seed), seconds, gradient, bestSeconds([&] { impactsAgain(motion); }, kBudget, 5),
             bestSeconds([&] { pathsAgain(motion); }, kBudget, 5), counts.impacts, counts.paths, counts.steps});
  }
}

}  // namespace carom::charts
