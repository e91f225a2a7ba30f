// SPDX-License-Identifier: MIT
// The tasks of edits_bench that start anywhere: what they promise of themselves.

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "adjoint/simulate/simulate.h"
#include "bench/edits/checks.h"
#include "bench/edits/tables.h"
#include "bench/edits/tasks.h"
#include "editing/problem/edit_problem.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace editing_detail;

namespace {

constexpr std::uint64_t kAnySeed = 1;

// Every sixth: some of each family, of each kind.
const std::vector<Task>& anywhereTasks() {
  static const std::vector<Task> all = [] {
    std::vector<Task> made;
    for (int i = kThrownTasks; i < kTasks; i += 6) made.push_back(makeTask(kAnySeed, i));
    for (int i = kThrownTasks + 1; i < kTasks; i += 42) made.push_back(makeTask(kAnySeed, i));
    return made;
  }();
  return all;
}

std::string named(const Task& task) {
  return std::string(nameOf(task.wanted.family)) + ", task " + std::to_string(task.index);
}

TEST(AnywhereTasks, AreTheSameEveryTime) {
  std::set<Family> compared;
  for (const Task& task : anywhereTasks()) {
    if (!compared.insert(task.wanted.family).second) continue;
    SCOPED_TRACE(named(task));
    const Task again = makeTask(kAnySeed, task.index);
    EXPECT_EQ(again.hidden_values, task.hidden_values);
    EXPECT_EQ(again.duration, task.duration);
    EXPECT_EQ(again.attempts, task.attempts);
    EXPECT_EQ(again.sequence, task.sequence);
  }
  EXPECT_EQ(compared.size(), static_cast<std::size_t>(kFamilies - kThrownFamilies));
}

TEST(AnywhereTasks, AreMetByTheirHiddenMotion) {
  for (const Task& task : anywhereTasks()) {
    SCOPED_TRACE(named(task));
    OdeContacts contacts(task.start);
    const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
    const Motion hidden = simulate(problem.controls.sceneAt(task.hidden_values), contacts, task.duration);
    const RowValues met = problem.constraints.evaluate(hidden);
    ASSERT_TRUE(met.available) << met.message;
    for (double residual : met.scaled) EXPECT_TRUE(std::abs(residual) <= 1e-10) << residual;
    EXPECT_TRUE(beginsWith(hidden, task.sequence));
    EXPECT_TRUE(task.growth <= TaskLimits::kLargestGrowth) << task.growth;
    EXPECT_LE(static_cast<int>(problem.constraints.equations().size()), task.numbers);
    for (int i = 0; i < problem.controls.size(); ++i) {
      const Variable& v = problem.controls.variables()[static_cast<std::size_t>(i)];
      EXPECT_TRUE(task.hidden_values[i] >= v.lower && task.hidden_values[i] <= v.upper) << v.component;
      EXPECT_TRUE(v.before >= v.lower && v.before <= v.upper) << v.component;
    }
  }
}

TEST(AnywhereTasks, AreMissedByTheirStart) {
  std::set<Family> lacking;
  for (const Task& task : anywhereTasks()) {
    SCOPED_TRACE(named(task));
    OdeContacts contacts(task.start);
    const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
    const Motion start = simulate(task.start, contacts, task.duration);
    const RowValues rows = problem.constraints.evaluate(start);
    EXPECT_EQ(rows.available, std::isfinite(task.miss));
    if (!rows.available) {
      lacking.insert(task.wanted.family);
      EXPECT_TRUE(task.sequence.empty() || !beginsWith(start, task.sequence));
    } else {
      EXPECT_TRUE(task.miss >= TaskLimits::kSmallestMiss) << task.miss;
      EXPECT_NEAR(task.miss, rows.scaled.cwiseAbs().maxCoeff(), 1e-9 * task.miss);
    }
  }
  for (Family family : {Family::chain, Family::encounter, Family::hit, Family::required})
    EXPECT_TRUE(lacking.contains(family)) << nameOf(family);
}

TEST(AnywhereTasks, HoldWhatTheirFamilySays) {
  for (const Task& task : anywhereTasks()) {
    SCOPED_TRACE(named(task));
    ASSERT_FALSE(task.constraints.empty());
    const Constraint& c = task.constraints[0];
    EXPECT_EQ(c.at.impact > 0, task.wanted.goal == Goal::at_an_impact);
    if (task.wanted.family == Family::hit) {
      EXPECT_TRUE(c.hits.has_value() || !c.at.with.empty());
    }
    EXPECT_EQ(c.hits.has_value() || !c.sequence.empty(), task.wanted.goal == Goal::impact_comes);
    EXPECT_EQ(c.sequence, task.sequence);
    EXPECT_EQ(task.sequence.empty(), task.wanted.family != Family::required);
    if (task.wanted.family == Family::speed) {
      constexpr const char* kWords[] = {"speed", "kinetic_energy", "height", "impulse"};
      EXPECT_EQ(task.constraints[0].targets[0].quantity, kWords[task.wanted.kind % 4]);
    }
    if (task.wanted.family == Family::distance) {
      EXPECT_EQ(c.targets[0].quantity, "distance");
    }
  }
}

TEST(AnywhereTasks, AreOfEveryKind) {
  std::set<std::tuple<int, int, Goal>> chains;
  std::set<int> layers, quantities;
  int hits = 0, required = 0;
  for (int i = kThrownTasks; i < kTasks; ++i) {
    const Wanted w = wantedOf(i);
    if (w.family == Family::chain) chains.emplace(w.balls, w.rails, w.goal);
    if (w.family == Family::rack) layers.insert(w.balls);
    if (w.family == Family::speed) quantities.insert(w.kind % 4);
    hits += w.family == Family::hit && w.goal == Goal::impact_comes;
    required += w.family == Family::required;
  }
  EXPECT_EQ(chains.size(), 3u * 4u * 2u);
  EXPECT_EQ(layers, (std::set{2, 3, 4}));
  EXPECT_EQ(quantities.size(), 4u);
  EXPECT_GE(hits, 20);
  EXPECT_GE(required, 50);
  EXPECT_THROW(wantedOf(kTasks), std::out_of_range);
  EXPECT_THROW(wantedOf(-1), std::out_of_range);
}

TEST(Sequence, IsThatOfTheImpactsOfOneBodyWithWhatIsNamedOrMoves) {
  Scene scene;
  scene.gravity.setZero();
  scene.materials = {Material{.name = "hard", .elasticity = 1, .friction = 0}};
  const auto body = [&](const char* name, Shape shape, const Vec3& place) -> Body& {
    Body b;
    b.name = name, b.material = "hard", b.shape = std::move(shape), b.position = place;
    scene.bodies.push_back(b);
    return scene.bodies.back();
  };
  body("rail_west", Plane{Vec3::UnitX(), -1}, Vec3::Zero()).fixed = true;
  body("rail_east", Plane{-Vec3::UnitX(), -2}, Vec3::Zero()).fixed = true;
  Body& cue = body("cue", Sphere{0.1}, Vec3::Zero());
  cue.mass = 1, cue.velocity = Vec3(-1, 0, 0);
  body("red", Sphere{0.1}, Vec3(1, 0, 0)).mass = 3;
  OdeContacts contacts(scene);
  // The cue ball comes off the west rail, strikes red, and goes back to that rail.
  const Motion motion = simulate(scene, contacts, 6);
  EXPECT_TRUE(beginsWith(motion, {}));
  EXPECT_TRUE(beginsWith(motion, {"cue rail_west"}));
  EXPECT_TRUE(beginsWith(motion, {"cue rail*", "cue red"}));
  EXPECT_TRUE(beginsWith(motion, {"cue rail*", "cue red", "cue rail*"}));
  EXPECT_TRUE(beginsWith(motion, {"red cue", "red rail_east"}));
  EXPECT_TRUE(beginsWith(motion, {"cue red"}));  // a rail that nobody names does not count
  EXPECT_FALSE(beginsWith(motion, {"cue red", "cue rail*"}));
  EXPECT_FALSE(beginsWith(motion, {"cue rail_east"}));
  EXPECT_FALSE(beginsWith(motion, {"cue rail*", "cue red", "cue red"}));
  EXPECT_FALSE(beginsWith(motion, std::vector<std::string>(9, "cue *")));  // there are not so many
}

}  // namespace
}  // namespace carom::bench
