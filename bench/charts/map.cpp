// SPDX-License-Identifier: MIT
#include "bench/charts/map.h"

#include <algorithm>
#include <cmath>

#include "bench/charts/engines/engine.h"

namespace carom::charts {
namespace {

// Largest difference of velocities; the spin of a ball counts only where there is friction.
double difference(const Scene& scene, const States& a, const States& b) {
  double worst = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.fixed) continue;
    const bool turns = !std::holds_alternative<Sphere>(body.shape) || materialOf(scene, body).friction > 0;
    const double reach = turns ? kindOf(body.shape).boundingRadius(body.shape) : 0;
    const double d = (a[i].velocity - b[i].velocity).norm() +
                     (turns ? reach * (a[i].angular_velocity - b[i].angular_velocity).norm() : 0);
    if (!(d <= worst)) worst = d;
    if (std::isnan(d)) return NAN;
  }
  return worst;
}

// The same scene without impacts. Spins are those of the start: a free body keeps its spin but for its wobble.
States untouched(const Scene& scene, double time) {
  States states = startOf(scene);
  for (std::size_t i = 0; i < states.size(); ++i)
    if (!scene.bodies[i].fixed) states[i].velocity += time * scene.gravity;
  return states;
}

}  // namespace

const char* nameOf(Outcome outcome) {
  constexpr const char* names[] = {"right", "close", "wrong", "missed", "gains", "blows_up", "says_so"};
  return names[static_cast<int>(outcome)];
}

Verdict judge(const Scene& scene, const States& found, const States& exact, double time) {
  const States free = untouched(scene, time);
  const double effect = difference(scene, exact, free);
  const double error = difference(scene, found, exact) / effect;
  const double before = energy(scene, startOf(scene)), after = energy(scene, found);
  // potential energy is counted from the exact end, so that heights far from zero do not hide a gain
  double zero = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    if (!scene.bodies[i].fixed) zero -= modelOf(scene.bodies[i]).mass * scene.gravity.dot(exact[i].position);
  const double scale = before - std::min(zero, before * (1 - 1e-9));
  if (!std::isfinite(error) || !std::isfinite(after) || after - before > 9 * scale) return {Outcome::blows_up, error};
  if (error > 0.5 && difference(scene, found, free) < 0.1 * effect) return {Outcome::missed, error};
  if (after - before > 0.01 * scale) return {Outcome::gains, error};
  return {error < 1e-9 ? Outcome::right : error < 0.01 ? Outcome::close : Outcome::wrong, error};
}

Map::Map(Csv& csv, const std::string& x, const std::string& y) : csv_(csv) {
  csv.note("right: to 1e-9 of what the impacts change of velocities; close: within 1 %; wrong: off by more");
  csv.note("missed: as if there had been no impact, or through a wall; gains: 1 % more energy than at the start");
  csv.note("blows_up: ten times as much energy, or no numbers; says_so: no answer, and a sentence why");
  csv.columns({"method", x, y, "outcome", "error"});
}

void Map::cell(const std::string& method, double x, double y, const Verdict& verdict) {
  csv_.row({method, x, y, nameOf(verdict.outcome), verdict.error});
}

Played play(const EngineKind& kind, const Scene& scene, double time, double dt) {
  const auto engine = kind.make(scene, dt);
  Played played;
  const auto read = [&] {
    played.states.clear();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) played.states.push_back(engine->state(static_cast<int>(i)));
  };
  const auto steps = static_cast<long>(std::ceil(time / dt - 1e-9));
  for (long i = 0; i < steps; ++i) engine->step();
  played.time = static_cast<double>(steps) * dt;
  read();
  return played;
}

}  // namespace carom::charts
