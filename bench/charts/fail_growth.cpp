// SPDX-License-Identifier: MIT
// Number of impacts: a ball flies among fixed ones, which scatter it. How fast small changes of its throw grow, how
// soon engines have lost its path, and how often an edit, which moves the ball's place at the end by two centimetres,
// succeeds.

#include <cmath>
#include <random>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "bench/charts/chart_scenes.h"
#include "bench/charts/engines/engine.h"
#include "bench/charts/map.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::charts {
namespace {

constexpr int kTargets = 6;
constexpr double kOffset = 0.02, kBudget = 1;  // m; s an edit
// Of the ball's size. A throw has sixteen digits, so that growth alone forbids the tighter one in the end.
constexpr double kTolerance = 1e-5, kTight = 1e-9;

Scene pinball() {
  Scene scene = emptyScene(1, 0, Vec3::Zero());
  constexpr double kSize = 0.5;
  for (const auto& [name, normal] : {std::pair("left", Vec3(1, 0, 0)), std::pair("right", Vec3(-1, 0, 0)),
                                     std::pair("near", Vec3(0, 1, 0)), std::pair("far", Vec3(0, -1, 0))})
    scene.bodies.push_back(fixedPlane(name, normal, -kSize));
  int number = 0;
  for (const Vec3& place :
       {Vec3(0.02, 0.01, 0), Vec3(-0.3, 0.28, 0), Vec3(0.27, 0.31, 0), Vec3(-0.29, -0.3, 0), Vec3(0.31, -0.27, 0)}) {
    Body post = movingBody("post " + std::to_string(++number), Sphere{0.1}, place, Vec3::Zero());
    post.fixed = true, post.mass.reset();
    scene.bodies.push_back(post);
  }
  scene.bodies.push_back(movingBody("ball", Sphere{0.03}, {-0.4, 0.03, 0}, {0.9, 0.31, 0}));
  return scene;
}

// Largest singular value of d(place at the end)/d(velocity of the throw), over that of a free flight, which is the
// time.
double growthOf(const Motion& motion, int ball) {
  Eigen::Matrix2d J;
  for (int i = 0; i < 2; ++i) {
    StateSeed seed;
    seed.body = ball, seed.at = Instant::at(motion.end), seed.position[i] = 1;
    const SceneGradient g = adjoint(motion, std::span(&seed, 1));
    J.row(i) = g.bodies[static_cast<std::size_t>(ball)].velocity.head<2>();
  }
  return J.jacobiSvd().singularValues()[0] / motion.end;
}

double shareSolved(const Scene& scene, double duration, const Vec3& end, double tolerance) {
  std::mt19937_64 engine(7);
  int solved = 0;
  for (int i = 0; i < kTargets; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(engine() >> 11) * 0x1p-53;
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, duration);
    edit.vary(velocity("ball").only({"x", "y"}));
    edit.nail("ball", duration).position(end.x() + kOffset * std::cos(angle), end.y() + kOffset * std::sin(angle), any);
    EditOptions options;
    options.sequence = SequencePolicy::stay;
    options.certify = options.explain = false;
    options.time_budget_seconds = kBudget;
    options.tolerance = tolerance;
    solved += edit.solve(options).solved();
  }
  return static_cast<double>(solved) / kTargets;
}

}  // namespace

void measure(Csv& csv) {
  csv.note("growth: how much further the end moves with the throw than in a free flight as long");
  csv.note(
      "solved, solved_tight (met to 1e-9): shares of edits solved within 1 s and within the impact sequence, "
      "by 6 targets at 2 cm, met to 1e-5 of the size");
  csv.note("others: distance of the engine's ball from carom's at the end, m, at steps of 1e-4 s");
  std::vector<std::string> names = {"impacts", "time", "growth", "solved", "solved_tight"};
  for (const EngineKind& kind : mapEngines()) names.push_back(kind.name);
  csv.columns(names);
  const Scene scene = pinball();
  const int ball = bodyIndex(scene, "ball");
  OdeContacts contacts(scene);
  const Motion whole = simulate(scene, contacts, 60, {25, {}});
  const std::vector<int> counts = {1, 2, 3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20};
  Progress progress(static_cast<int>(counts.size()));
  for (const int count : counts) {
    progress.next(std::to_string(count) + " impacts");
    const auto n = static_cast<std::size_t>(count);
    const double end = 0.5 * (whole.events.at(n - 1).time + whole.events.at(n).time);
    const Motion motion = simulate(scene, contacts, end);
    const Vec3 place = motion.stateAt(ball, end).position;
    std::vector<Cell> row = {count,
                             end,
                             growthOf(motion, ball),
                             shareSolved(scene, end, place, kTolerance),
                             shareSolved(scene, end, place, kTight)};
    for (const EngineKind& kind : mapEngines()) {
      const Played played = play(kind, scene, end, 1e-4);
      const BodyState& s = played.states[static_cast<std::size_t>(ball)];
      row.push_back((s.position - (played.time - end) * s.velocity - place).norm());
    }
    csv.row(row);
  }
}

}  // namespace carom::charts
