// SPDX-License-Identifier: MIT
// Grazing angle against elasticity: a ball flies past a fixed one and just touches it.

#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/map.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr double kRadius = 0.05, kSpeed = 5, kEnd = 0.2;

// At the impact the velocity stands at `angle` to the tangent: |n.u|/|u| = sin(angle).
Scene passing(double angle, double elasticity) {
  Scene scene = emptyScene(elasticity, 0, Vec3::Zero());
  Body fixed = movingBody("fixed", Sphere{kRadius}, Vec3::Zero(), Vec3::Zero());
  fixed.fixed = true, fixed.mass.reset();
  scene.bodies = {fixed,
                  movingBody("ball", Sphere{kRadius}, {-0.4987, 2 * kRadius * std::cos(angle), 0}, {kSpeed, 0, 0})};
  return scene;
}

// Normal at the impact (-sin, cos), v+ = v - (1 + e) (n.v) n, for the height as it is rounded in the scene.
States exactEnd(const Scene& scene, double elasticity) {
  States states = startOf(scene);
  const long double R = 2 * static_cast<long double>(kRadius), y = states[1].position.y();
  const long double s = std::sqrt((R - y) * (R + y)) / R, c = y / R, change = (1 + elasticity) * s * kSpeed;
  states[1].velocity += Vec3(static_cast<double>(-change * s), static_cast<double>(change * c), 0);
  return states;
}

}  // namespace

void measure(Csv& csv) {
  csv.note("angle: radians between velocity and tangent at the impact; engines at steps of 1e-3 s (5 mm)");
  Map map(csv, "angle", "elasticity");
  const std::vector<double> angles = logSpaced(1e-7, 1.5, 44), elasticities = evenlySpaced(0, 1, 21);
  Progress progress(static_cast<int>(angles.size()));
  for (const double angle : angles) {
    progress.next("angle " + Cell(angle).text);
    for (const double e : elasticities) {
      const Scene scene = passing(angle, e);
      const States exact = exactEnd(scene, e);
      for (const EngineKind& kind : mapEngines())
        map.cell(kind.name, angle, e, judge(scene, play(kind, scene, kEnd, kMapStep).states, exact, kEnd));
      OdeContacts contacts(scene);
      const Motion motion = simulate(scene, contacts, kEnd);
      map.cell("carom", angle, e, judge(scene, statesAt(motion, kEnd), exact, kEnd));
      // the derivative of the end by the throw, whose margin is that of the impact
      Reliability reliability;
      StateSeed seed;
      seed.body = 1, seed.at = Instant::at(kEnd), seed.velocity = Vec3::UnitX();
      adjoint(motion, std::span(&seed, 1), &reliability);
      Verdict gradient = judge(scene, statesAt(motion, kEnd), exact, kEnd);
      if (!reliability.reliable) gradient.outcome = Outcome::says_so;
      map.cell("carom gradient", angle, e, gradient);
    }
  }
}

}  // namespace carom::charts
