// SPDX-License-Identifier: MIT
// Simulate, one adjoint row, the full Jacobian and a whole edit, for example scenes and for boxes with three impacts.
//   carom_bench --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
// Ratios (adjoint row over simulate) are to be read within one run: machines are noisy.

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <span>
#include <string>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

struct Case {
  explicit Case(const std::string& name)
      : document(readDocument(std::string(CAROM_SCENES_DIR) + "/" + name + ".json")),
        contacts(document.scene),
        edit(document.scene, contacts, document.duration, document.controls, document.constraints),
        problem(edit.problem()),
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
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
