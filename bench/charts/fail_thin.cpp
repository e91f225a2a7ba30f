// SPDX-License-Identifier: MIT
// Spin against thinness: a spinning plate is thrown at a fixed plate as thin as itself.

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/map.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/reference/replayed.h"

namespace carom::charts {
namespace {

constexpr double kAfter = 0.02;  // s after the first impact

Scene thrown(double spin, double thickness) {
  Scene scene = emptyScene(0.5, 0, Vec3::Zero());
  Body target = movingBody("target", Box{{0.4, 0.4, thickness}}, Vec3::Zero(), Vec3::Zero());
  target.fixed = true, target.mass.reset();
  Body plate = movingBody("plate", Box{{0.2, 0.15, thickness}}, {0.01, 0.02, 0.3}, {0.3, 0.1, -20});
  plate.orientation = Quat(1, 0.02, -0.03, 0.01).normalized();
  plate.angular_velocity = spin * Vec3(1, 0.4, 0.3).normalized();
  scene.bodies = {target, plate};
  return scene;
}

// Fifty digits along carom's sequence of impacts: that none is missing in it is tested elsewhere, by brute force.
States exactEnd(const Scene& scene, const Motion& motion, double t) {
  const reference::Reference reference(scene, reference::sequenceOf(motion));
  return {reference.stateAt(0, t), reference.stateAt(1, t)};
}

}  // namespace

void measure(Csv& csv) {
  csv.note(
      "spin: rad/s; thickness: of both plates, m; 20 m/s, engines at steps of 1e-3 s; judged 0.02 s after the first "
      "impact");
  Map map(csv, "spin", "thickness");
  const std::vector<double> spins = logSpaced(1, 1000, 19), sizes = logSpaced(1e-1, 1e-4, 16);
  Progress progress(static_cast<int>(spins.size()));
  for (const double spin : spins) {
    progress.next("spin " + Cell(spin).text);
    for (const double thickness : sizes) {
      const Scene scene = thrown(spin, thickness);
      OdeContacts contacts(scene);
      const double t = simulate(scene, contacts, 1, {1, {}}).end;  // the time of the second impact, or 1 s
      const double first = simulate(scene, contacts, t).events.at(0).time, end = first + kAfter;
      const Motion motion = simulate(scene, contacts, end);
      const States exact = exactEnd(scene, motion, end);
      for (const EngineKind& kind : mapEngines()) {
        const States found = play(kind, scene, end, kMapStep).states;
        Verdict verdict = judge(scene, found, exact, end);
        const bool through = found[1].position.z() < 0 && exact[1].position.z() > 0;
        if (through && verdict.outcome != Outcome::blows_up) verdict.outcome = Outcome::missed;
        map.cell(kind.name, spin, thickness, verdict);
      }
      map.cell("carom", spin, thickness,
               motion.status == MotionStatus::complete ? judge(scene, statesAt(motion, end), exact, end)
                                                       : Verdict{Outcome::says_so, NAN});
    }
  }
}

}  // namespace carom::charts
