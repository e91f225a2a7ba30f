// SPDX-License-Identifier: MIT
// Stick and slide: a ball without spin strikes a floor under gravity-free flight, at some angle and with some friction.

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/map.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr double kRadius = 0.1, kElasticity = 0.5, kDown = 3, kEnd = 0.1;

// Along the floor, off the axes: many engines limit friction in two directions of their own, not in all alike.
Vec3 direction() { return {std::cos(0.5), std::sin(0.5), 0}; }

Scene skidding(double slope, double friction) {
  Scene scene = emptyScene(kElasticity, friction, Vec3::Zero());
  scene.bodies = {
      fixedPlane("floor", Vec3::UnitZ(), 0),
      movingBody("ball", Sphere{kRadius}, {0, 0, 0.22 + 1e-4}, slope * kDown * direction() - kDown * Vec3::UnitZ())};
  return scene;
}

// With j = 2/5 r^2 the tangential impulse that stops the contact point is 2/7 of the momentum along the floor; friction
// gives no more than mu (1 + e) of the momentum across it.
States exactEnd(const Scene& scene, double slope, double friction) {
  States states = startOf(scene);
  const double tangential = std::min(2.0 / 7 * slope * kDown, friction * (1 + kElasticity) * kDown);
  states[1].velocity = (slope * kDown - tangential) * direction() + kElasticity * kDown * Vec3::UnitZ();
  states[1].angular_velocity = tangential / (0.4 * kRadius) * Vec3::UnitZ().cross(direction());
  return states;
}

}  // namespace

void measure(Csv& csv) {
  csv.note("slope: velocity along the floor over that towards it; elasticity 0.5; engines at steps of 1e-3 s");
  Map map(csv, "slope", "friction");
  const std::vector<double> slopes = logSpaced(1e-2, 1e2, 33), frictions = logSpaced(1e-2, 1e1, 25);
  Progress progress(static_cast<int>(slopes.size()));
  for (const double slope : slopes) {
    progress.next("slope " + Cell(slope).text);
    for (const double friction : frictions) {
      const Scene scene = skidding(slope, friction);
      const States exact = exactEnd(scene, slope, friction);
      for (const EngineKind& kind : mapEngines())
        map.cell(kind.name, slope, friction, judge(scene, play(kind, scene, kEnd, kMapStep).states, exact, kEnd));
      OdeContacts contacts(scene);
      const Motion motion = simulate(scene, contacts, kEnd);
      map.cell("carom", slope, friction, judge(scene, statesAt(motion, kEnd), exact, kEnd));
    }
  }
}

}  // namespace carom::charts
