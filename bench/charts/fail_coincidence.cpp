// SPDX-License-Identifier: MIT
// Two impacts that nearly fall together: a ball strikes two others, the second one a little later. However short the
// time between the two, what happens is one impact after the other; at no time between them it is a matter of choice.

#include <array>
#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/map.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr double kRadius = 0.05, kSpeed = 3, kEnd = 0.2;

Scene nearlyTogether(double gap, double elasticity) {
  Scene scene = emptyScene(elasticity, 0, Vec3::Zero());
  const double x = 2 * kRadius * std::cos(0.7), y = 2 * kRadius * std::sin(0.7);
  // the contacts would be made with the cue ball at the origin, and kSpeed gap further; in the middle of a step
  scene.bodies = {movingBody("cue", Sphere{kRadius}, {-0.3013, 0, 0}, {kSpeed, 0, 0}),
                  movingBody("first", Sphere{kRadius}, {x, y, 0}, Vec3::Zero()),
                  movingBody("second", Sphere{kRadius}, {x + kSpeed * gap, -y, 0}, Vec3::Zero())};
  return scene;
}

using Pair = std::array<long double, 2>;
struct Ball {
  Pair x, v;
};

long double dot(const Pair& a, const Pair& b) { return a[0] * b[0] + a[1] * b[1]; }

// Time until two balls touch, infinite if never.
long double meeting(const Ball& a, const Ball& b) {
  const Pair d{b.x[0] - a.x[0], b.x[1] - a.x[1]}, u{b.v[0] - a.v[0], b.v[1] - a.v[1]};
  const long double approach = -dot(d, u), R = 2 * static_cast<long double>(kRadius);
  if (!(approach > 0)) return INFINITY;
  const long double c = dot(d, d) - R * R, root = approach * approach - dot(u, u) * c;
  if (root < 0) return INFINITY;
  return std::max(0.0L, c / (approach + std::sqrt(root)));
}

// One impact after the other, in extended precision.
States exactEnd(const Scene& scene) {
  std::array<Ball, 3> balls;
  for (std::size_t i = 0; i < 3; ++i) {
    const Body& b = scene.bodies[i];
    balls[i] = {{b.position.x(), b.position.y()}, {b.velocity.x(), b.velocity.y()}};
  }
  const long double e = scene.materials[0].elasticity;
  for (long double t = 0;;) {
    long double next = INFINITY;
    std::size_t a = 0, b = 0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = i + 1; k < 3; ++k)
        if (const long double m = meeting(balls[i], balls[k]); m < next) next = m, a = i, b = k;
    if (!(t + next < kEnd)) break;
    t += next;
    for (Ball& ball : balls)
      for (std::size_t i = 0; i < 2; ++i) ball.x[i] += next * ball.v[i];
    Pair n{balls[b].x[0] - balls[a].x[0], balls[b].x[1] - balls[a].x[1]};
    const long double length = std::sqrt(dot(n, n));
    for (long double& component : n) component /= length;
    const long double approach = dot(n, {balls[a].v[0] - balls[b].v[0], balls[a].v[1] - balls[b].v[1]});
    for (std::size_t i = 0; i < 2; ++i) {
      balls[a].v[i] -= (1 + e) / 2 * approach * n[i];
      balls[b].v[i] += (1 + e) / 2 * approach * n[i];
    }
  }
  States states = startOf(scene);
  for (std::size_t i = 0; i < 3; ++i)
    states[i].velocity = {static_cast<double>(balls[i].v[0]), static_cast<double>(balls[i].v[1]), 0};
  return states;
}

}  // namespace

void measure(Csv& csv) {
  csv.note("gap: seconds between the two impacts; engines at steps of 1e-3 s; carom solves them as one below 1e-10 s");
  Map map(csv, "gap", "elasticity");
  const std::vector<double> gaps = logSpaced(1e-2, 1e-14, 37), elasticities = evenlySpaced(0.05, 1, 20);
  Progress progress(static_cast<int>(gaps.size()));
  for (const double gap : gaps) {
    progress.next("gap " + Cell(gap).text);
    for (const double e : elasticities) {
      const Scene scene = nearlyTogether(gap, e);
      const States exact = exactEnd(scene);
      for (const EngineKind& kind : mapEngines())
        map.cell(kind.name, gap, e, judge(scene, play(kind, scene, kEnd, kMapStep).states, exact, kEnd));
      OdeContacts contacts(scene);
      const Motion motion = simulate(scene, contacts, kEnd);
      Verdict verdict{Outcome::says_so, NAN};
      if (motion.status == MotionStatus::complete) verdict = judge(scene, statesAt(motion, kEnd), exact, kEnd);
      // "joint" stands in the motion's list of impacts: the answer is that of the law for impacts of one instant
      for (const Event& event : motion.events)
        if (event.mode == ImpactMode::joint) verdict.outcome = Outcome::says_so;
      map.cell("carom", gap, e, verdict);
    }
  }
}

}  // namespace carom::charts
