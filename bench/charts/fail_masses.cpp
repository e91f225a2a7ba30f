// SPDX-License-Identifier: MIT
// Mass ratio: a heavy ball drives a light one against a wall. The light one flies to and fro between them, faster and
// faster, until the heavy one has turned round; all impacts are elastic. With masses 1 and 100^k the number of impacts
// is the first k + 1 digits of pi (G. Galperin, Regular and Chaotic Dynamics 8, 2003).

#include <algorithm>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/map.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr double kRadius = 0.1, kEnd = 4;

Scene between(double ratio) {
  Scene scene = emptyScene(1, 0, Vec3::Zero());
  Body heavy = movingBody("heavy", Sphere{kRadius}, {1.35, 0, 0}, {-1, 0, 0});
  heavy.mass = ratio;
  scene.bodies = {fixedPlane("wall", Vec3::UnitX(), 0), movingBody("light", Sphere{kRadius}, {0.6, 0, 0}, Vec3::Zero()),
                  heavy};
  return scene;
}

struct Exact {
  States end;
  int impacts;
};

// From impact to impact in extended precision, along the line.
Exact exactEnd(const Scene& scene, double ratio) {
  const long double M = ratio;
  long double t = 0, x = scene.bodies[1].position.x() - kRadius, y = scene.bodies[2].position.x() - 3 * kRadius;
  long double v = scene.bodies[1].velocity.x(), w = scene.bodies[2].velocity.x();
  Exact exact{startOf(scene), 0};
  while (true) {  // x and y are the places of two points, x of the light one, with a wall at 0
    const long double wall = v < 0 ? -x / v : INFINITY, meeting = v > w ? (y - x) / (v - w) : INFINITY;
    const long double next = std::min(wall, meeting);
    if (!(t + next < kEnd)) break;
    t += next, x += next * v, y += next * w, ++exact.impacts;
    if (wall < meeting) {
      v = -v, x = 0;
    } else {
      const long double mean = (v + M * w) / (1 + M);
      v = 2 * mean - v, w = 2 * mean - w, x = y;
    }
  }
  exact.end[1].velocity.x() = static_cast<double>(v);
  exact.end[2].velocity.x() = static_cast<double>(w);
  return exact;
}

}  // namespace

void measure(Csv& csv) {
  csv.note("ratio: mass of the heavy ball over that of the light one; step: of the engines, s; carom has none");
  Map map(csv, "ratio", "step");
  const std::vector<double> ratios = logSpaced(1.3, 1.3e8, 25), steps = logSpaced(1e-1, 3.16e-4, 11);
  Progress progress(static_cast<int>(ratios.size()));
  for (const double ratio : ratios) {
    progress.next("mass ratio " + Cell(ratio).text);
    const Scene scene = between(ratio);
    const Exact exact = exactEnd(scene, ratio);
    for (const EngineKind& kind : mapEngines())
      for (const double step : steps)
        map.cell(kind.name, ratio, step, judge(scene, play(kind, scene, kEnd, step).states, exact.end, kEnd));
    OdeContacts contacts(scene);
    SimulateOptions options;
    options.impact_limit = 100000;
    const Motion motion = simulate(scene, contacts, kEnd, options);
    Verdict verdict{Outcome::says_so, NAN};
    if (motion.status == MotionStatus::complete) verdict = judge(scene, statesAt(motion, kEnd), exact.end, kEnd);
    if (motion.status == MotionStatus::complete && static_cast<int>(motion.impacts) != exact.impacts)
      verdict.outcome = Outcome::wrong;
    for (const double step : steps) map.cell("carom", ratio, step, verdict);
  }
}

}  // namespace carom::charts
