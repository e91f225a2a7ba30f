// SPDX-License-Identifier: MIT
// Restitution towards 0 and 1: a ball dropped from 1 m, at half of the time in which its bounces come to an end, or
// after 5 s where they go on for longer; and once more when it lies still.

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/map.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr double kGravity = 9.81, kHeight = 1, kRadius = 0.1, kLongest = 5;
constexpr std::size_t kMostImpacts = 200000;  // of a motion to rest; e = 1 - 1e-6 would take 14 million, in ten days

Scene dropped(double elasticity) {
  Scene scene = emptyScene(elasticity, 0, {0, 0, -kGravity});
  scene.bodies = {fixedPlane("floor", Vec3::UnitZ(), 0),
                  movingBody("ball", Sphere{kRadius}, {0, 0, kRadius + kHeight}, Vec3::Zero())};
  return scene;
}

// Bounce n is at t1 (1 + 2 (e + ... + e^(n-1))), and leaves with g t1 e^n.
States exactAt(const Scene& scene, long double e, long double t) {
  States states = startOf(scene);
  const long double g = kGravity, t1 = std::sqrt(2 * static_cast<long double>(kHeight) / g);
  if (t >= t1 * (1 + e) / (1 - e)) {
    states[1].position.z() = kRadius;
    return states;
  }
  long double from = -t1, speed = g * t1;  // of a bounce before the start that leads to the drop
  while (t > from + 2 * speed / g) from += 2 * speed / g, speed *= e;
  const long double s = t - from;
  states[1].position.z() = static_cast<double>(kRadius + s * (speed - g * s / 2));
  states[1].velocity.z() = static_cast<double>(speed - g * s);
  return states;
}

double restTime(double e) { return std::sqrt(2 * kHeight / kGravity) * (1 + e) / (1 - e); }

// A moment in the middle of a flight, so that engines that are a little late are not judged across a bounce.
double middleOfFlight(double e, double t) {
  const double t1 = std::sqrt(2 * kHeight / kGravity);
  double from = t1, length = 2 * e * t1;
  while (from + length < t) from += length, length *= e;
  return from + 0.3 * length;
}

// After the bounces have ended: velocities are judged as everywhere, and the ball has to lie on the floor.
Verdict judgeRest(const Scene& scene, OdeContacts& contacts, double e) {
  const double t = 1.1 * restTime(e);
  SimulateOptions options;
  options.impact_limit = kMostImpacts;
  options.record_events = false;
  const Motion motion = simulate(scene, contacts, t, options);
  if (motion.status != MotionStatus::complete) return {Outcome::says_so, NAN};
  const States exact = exactAt(scene, e, t), found = statesAt(motion, t);
  Verdict verdict = judge(scene, found, exact, t);
  verdict.error = std::max(verdict.error, (found[1].position - exact[1].position).norm() / kHeight);
  if (verdict.outcome == Outcome::right && !(verdict.error < 1e-9)) verdict.outcome = Outcome::wrong;
  return verdict;
}

}  // namespace

void measure(Csv& csv) {
  csv.note("odds: e/(1 - e), so that both ends can be seen; step: of the engines, s");
  csv.note("carom at rest: carom asked for a time after the bounces have ended, place and velocity; says_so: after " +
           Cell(kMostImpacts).text + " impacts it stops");
  Map map(csv, "odds", "step");
  const std::vector<double> odds = logSpaced(1e-3, 1e6, 28), steps = logSpaced(1e-2, 3.16e-4, 7);
  Progress progress(static_cast<int>(odds.size()));
  for (const double odd : odds) {
    const double e = odd / (1 + odd), t = middleOfFlight(e, std::min(0.5 * restTime(e), kLongest));
    progress.next("elasticity " + Cell(e).text);
    const Scene scene = dropped(e);
    const States exact = exactAt(scene, e, t);
    for (const EngineKind& kind : mapEngines())
      for (const double step : steps) {
        const Played played = play(kind, scene, t, step);
        map.cell(kind.name, odd, step, judge(scene, played.states, exactAt(scene, e, played.time), played.time));
      }
    OdeContacts contacts(scene);
    const Motion motion = simulate(scene, contacts, t);
    Verdict verdict{Outcome::says_so, NAN};
    if (motion.status == MotionStatus::complete) verdict = judge(scene, statesAt(motion, t), exact, t);
    const Verdict rest = judgeRest(scene, contacts, e);
    for (const double step : steps) {
      map.cell("carom", odd, step, verdict);
      map.cell("carom at rest", odd, step, rest);
    }
  }
}

}  // namespace carom::charts
