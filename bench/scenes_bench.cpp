// SPDX-License-Identifier: MIT
// Simulate, one adjoint row, the full Jacobian and a whole edit, for example scenes and for boxes with three impacts.
//   carom_bench --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
// Ratios (adjoint row over simulate) are to be read within one run: machines are noisy.

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "editing/problem_of.hpp"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

struct Case {
  explicit Case(const std::string& name)
      : document(readDocument(projectFile("examples/scenes/") + name + ".json")),
        contacts(document.scene),
        edit(document.scene, contacts, document.duration, document.controls, document.constraints),
        problem(problemOf(edit)),
        values(problem.controls.startValues()) {}

  Motion motion() { return simulate(document.scene, contacts, problem.horizon, {20000, problem.asked}); }
  int mover() const {
    for (std::size_t i = 0; i < document.scene.bodies.size(); ++i)
      if (!document.scene.bodies[i].fixed) return static_cast<int>(i);
    return 0;
  }

  Document document;
  OdeContacts contacts;
  Edit edit;
  EditProblem problem;
  Eigen::VectorXd values;
};

Case& caseOf(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Case>> cases;
  auto& slot = cases[name];
  if (!slot) slot = std::make_unique<Case>(name);
  return *slot;
}

// A box with three different moments that tumbles on a floor with friction: three impacts.
void simulateThreeImpacts(benchmark::State& state) {
  Scene scene;
  scene.materials.push_back({.name = "wood", .elasticity = 0.6, .friction = 0.3});
  Body floor, box;
  floor.name = "floor", floor.fixed = true, floor.material = "wood", floor.shape = Plane{};
  box.name = "box", box.material = "wood", box.mass = 1, box.shape = Box{{0.3, 0.2, 0.12}};
  box.position = {0, 0, 0.5}, box.velocity = {1, 0.3, -1}, box.angular_velocity = {2, 3, 1};
  scene.bodies = {floor, box};
  OdeContacts contacts(scene);
  const double duration = simulate(scene, contacts, 5, {3, {}}).end;  // up to the fourth impact
  std::size_t impacts = 0;
  for (auto _ : state) {
    const Motion motion = simulate(scene, contacts, 0.999 * duration);
    impacts = motion.events.size();
    benchmark::DoNotOptimize(motion.end);
  }
  state.counters["impacts"] = static_cast<double>(impacts);
  state.counters["seconds"] = 0.999 * duration;
}

// A ball of 0.1 m on a floor: how long an event, with the path or flight after it, takes.
void simulateBall(benchmark::State& state, double elasticity, double friction, double height, double speed) {
  Scene scene;
  scene.materials.push_back({.name = "ivory", .elasticity = elasticity, .friction = friction});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "ivory", floor.shape = Plane{};
  ball.name = "ball", ball.material = "ivory", ball.mass = 1, ball.shape = Sphere{0.1};
  ball.position = {0, 0, 0.1 + height}, ball.velocity = {speed, 0, 0};
  scene.bodies = {floor, ball};
  OdeContacts contacts(scene);
  std::size_t events = 0;
  for (auto _ : state) {
    const Motion motion = simulate(scene, contacts, 60);
    if (motion.status != MotionStatus::complete) return state.SkipWithError(motion.message.c_str());
    events = motion.events.size();
    benchmark::DoNotOptimize(motion.end);
  }
  state.counters["events"] = static_cast<double>(events);
  if (events == 0) return;
  state.counters["seconds_per_event"] = benchmark::Counter(
      static_cast<double>(events), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
// A scene without events, to be taken off the next two; 218 bounces and a rest; a slide and rolling.
void ballFlies(benchmark::State& state) { simulateBall(state, 0, 0, 2e4, 3); }
void ballBouncesToRest(benchmark::State& state) { simulateBall(state, 0.95, 0, 1, 0); }
void ballSlidesAndRolls(benchmark::State& state) { simulateBall(state, 0, 0.3, 0, 3); }

void simulateAgain(benchmark::State& state, const std::string& name) {
  Case& c = caseOf(name);
  std::size_t impacts = 0;
  for (auto _ : state) {
    const Motion motion = c.motion();
    impacts = motion.events.size();
    benchmark::DoNotOptimize(motion.end);
  }
  state.counters["impacts"] = static_cast<double>(impacts);
}

// One row at the end, by every number of the scene.
void adjointRow(benchmark::State& state, const std::string& name) {
  Case& c = caseOf(name);
  const Motion motion = c.motion();
  StateSeed seed;
  seed.body = c.mover();
  seed.at = Instant::at(motion.end);
  seed.position = Vec3::UnitX();
  if (motion.plan.bodies[static_cast<std::size_t>(seed.body)].tier != Tier::none) seed.orientation = Vec3::UnitY();
  for (auto _ : state) {
    const SceneGradient gradient = adjoint(motion, std::span(&seed, 1));
    benchmark::DoNotOptimize(gradient.gravity);
  }
}

void fullJacobian(benchmark::State& state, const std::string& name) {
  Case& c = caseOf(name);
  const RowsAndJacobian at = evaluateByAdjoint(c.problem, c.values);
  for (auto _ : state) benchmark::DoNotOptimize(jacobianByAdjoint(c.problem, c.values, at.motion, at.rows));
  state.counters["rows"] = static_cast<double>(at.jacobian.rows());
  state.counters["controls"] = static_cast<double>(at.jacobian.cols());
}

void wholeEdit(benchmark::State& state, const std::string& name) {
  Case& c = caseOf(name);
  int iterations = 0;
  double residual = 0;
  for (auto _ : state) {
    const EditResult result = c.edit.solve();
    iterations = result.iterations;
    residual = result.residual;
  }
  state.counters["iterations"] = iterations;
  state.counters["residual"] = residual;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  for (const char* scene : {"book-on-shelf", "billiard-three-balls"}) {
    const std::string name = scene;
    const auto add = [&](const char* what, void (*function)(benchmark::State&, const std::string&)) {
      benchmark::RegisterBenchmark((std::string(what) + "/" + name).c_str(), function, name)
          ->Unit(benchmark::kMicrosecond);
    };
    add("simulate", carom::simulateAgain);
    add("adjoint_row", carom::adjointRow);
    add("full_jacobian", carom::fullJacobian);
    add("edit", carom::wholeEdit);
  }
  benchmark::RegisterBenchmark("simulate/box_three_impacts", carom::simulateThreeImpacts)
      ->Unit(benchmark::kMicrosecond);
  for (const auto& [name, function] : {std::pair("simulate/ball_flies", &carom::ballFlies),
                                       std::pair("simulate/ball_bounces_to_rest", &carom::ballBouncesToRest),
                                       std::pair("simulate/ball_slides_and_rolls", &carom::ballSlidesAndRolls)})
    benchmark::RegisterBenchmark(name, function)->Unit(benchmark::kMicrosecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
