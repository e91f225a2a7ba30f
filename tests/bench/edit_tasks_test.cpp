// SPDX-License-Identifier: MIT
// The tasks of edits_bench: what they promise of themselves.

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "adjoint/simulate/simulate.h"
#include "bench/edits/best_known.h"
#include "bench/edits/dice.h"
#include "bench/edits/tasks.h"
#include "bench/edits/varied.h"
#include "editing/problem/edit_problem.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace editing_detail;

namespace {

constexpr std::uint64_t kSeed = 1;
constexpr int kMade = 48;  // every family with every goal, of each three needs

const std::vector<Task>& tasks() {
  static const std::vector<Task> all = [] {
    std::vector<Task> made;
    for (int i = 0; i < kMade; ++i) made.push_back(makeTask(kSeed, i));
    return made;
  }();
  return all;
}

std::string nameOfTask(const Task& task) {
  return "seed " + std::to_string(task.seed) + " task " + std::to_string(task.index);
}

TEST(Dice, AreThoseOfThePublishedGenerator) {
  // First outputs of splitmix64 from the states that a Dice passes through.
  Dice dice(1234567, 0, 0);
  const auto splitmix = [](std::uint64_t& state) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  };
  std::uint64_t state = 1234567;
  EXPECT_EQ(splitmix(state), 6457827717110365317u);  // of the reference implementation
  state = 6457827717110365317u;
  state = splitmix(state);
  EXPECT_EQ(dice.bits(), splitmix(state));
}

TEST(EditTasks, AreTheSameEveryTime) {
  for (int index : {0, 5, 10, 15}) {
    const Task again = makeTask(kSeed, index);
    const Task& task = tasks()[static_cast<std::size_t>(index)];
    EXPECT_EQ(again.hidden_values, task.hidden_values) << nameOfTask(task);
    EXPECT_EQ(again.duration, task.duration);
    EXPECT_EQ(again.attempts, task.attempts);
    ASSERT_EQ(again.constraints.size(), task.constraints.size());
    for (std::size_t i = 0; i < task.constraints.size(); ++i)
      EXPECT_EQ(again.constraints[i].at.time, task.constraints[i].at.time);
  }
  EXPECT_NE(makeTask(kSeed + 1, 0).duration, tasks()[0].duration);
}

TEST(EditTasks, AreMetByTheirHiddenThrowAndNotByTheirStart) {
  for (const Task& task : tasks()) {
    SCOPED_TRACE(nameOfTask(task));
    OdeContacts contacts(task.start);
    const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
    const Motion hidden = simulate(problem.controls.sceneAt(task.hidden_values), contacts, task.duration);
    const Motion start = simulate(task.start, contacts, task.duration);
    EXPECT_EQ(hidden.status, MotionStatus::complete);
    EXPECT_EQ(start.status, MotionStatus::complete);
    const RowValues met = problem.constraints.evaluate(hidden), missed = problem.constraints.evaluate(start);
    ASSERT_TRUE(met.available && missed.available);
    for (double residual : met.scaled) EXPECT_TRUE(std::abs(residual) <= 1e-10) << residual;
    EXPECT_TRUE(missed.scaled.cwiseAbs().maxCoeff() >= TaskLimits::kSmallestMiss);
    const auto extent = problem.constraints.extentIn(hidden);
    EXPECT_EQ(extent.events, static_cast<std::size_t>(task.wanted.impacts));
    const bool other = hidden.signature(extent.events) != start.signature(problem.constraints.extentIn(start).events);
    EXPECT_EQ(other, task.wanted.other_sequence);
  }
}

TEST(EditTasks, KeepTheirHiddenThrowNearAndInsideItsBounds) {
  for (const Task& task : tasks()) {
    SCOPED_TRACE(nameOfTask(task));
    OdeContacts contacts(task.start);
    const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
    EXPECT_GE(problem.controls.size(), kFewestNumbers);
    EXPECT_LE(problem.controls.size(), kMostNumbers);
    for (int i = 0; i < problem.controls.size(); ++i) {
      const Variable& v = problem.controls.variables()[static_cast<std::size_t>(i)];
      EXPECT_TRUE(task.hidden_values[i] >= v.lower && task.hidden_values[i] <= v.upper) << v.component;
    }
    const Eigen::VectorXd validity = problem.validity.evaluate(problem.controls, task.hidden_values);
    for (double h : validity) EXPECT_TRUE(h > 0) << h;
    EXPECT_TRUE(task.hidden_distance >= TaskLimits::kNearest);
    const double farthest = task.wanted.other_sequence ? TaskLimits::kFarthestOther : TaskLimits::kFarthestSame;
    EXPECT_TRUE(task.hidden_distance <= farthest * (1 + 1e-12));
  }
}

TEST(EditTasks, AreBalanced) {
  std::array<std::array<int, kThrownGoals>, kThrownFamilies> combinations{};
  std::set<int> impacts, impacts_of_others;
  int others = 0;
  constexpr int kAll = 288;  // every family, goal and need equally often
  for (int i = 0; i < kAll; ++i) {
    const Wanted w = wantedOf(i);
    ++combinations[static_cast<std::size_t>(w.family)][static_cast<std::size_t>(w.goal)];
    impacts.insert(w.impacts);
    if (w.other_sequence) ++others, impacts_of_others.insert(w.impacts);
  }
  for (const auto& row : combinations)
    for (int count : row) EXPECT_EQ(count, kAll / (kThrownFamilies * kThrownGoals));
  EXPECT_EQ(others, kAll / 3);
  EXPECT_EQ(impacts.size(), static_cast<std::size_t>(kMostImpacts));
  EXPECT_EQ(*impacts.begin(), 1);
  EXPECT_EQ(impacts_of_others, impacts);
}

TEST(EditTasks, VaryEveryKindOfControl) {
  std::set<std::string> kinds;
  bool bounded = false, weighted = false, partial = false;
  for (const Task& task : tasks()) {
    for (const Control& c : task.controls) {
      kinds.insert(c.vary);
      bounded |= !c.min.empty(), weighted |= c.weight != 1, partial |= !c.components.empty();
    }
  }
  for (const char* kind : {"velocity", "angular_velocity", "position", "orientation", "elasticity", "friction",
                           "tangential_elasticity", "mass", "inertia", "tilt"})
    EXPECT_TRUE(kinds.contains(kind)) << kind;
  EXPECT_TRUE(bounded && weighted && partial);
}

TEST(BestKnownChange, IsTheHiddenOneUntilASmallerOneIsFound) {
  const std::string file = testing::TempDir() + "best_known.csv";
  std::remove(file.c_str());
  const Task& task = tasks()[0];
  const double hidden = task.hidden_objective;
  {
    BestKnown best(file);
    EXPECT_EQ(best.of(task), hidden);
    best.offer(task, 2 * hidden, "worse");
    EXPECT_EQ(best.of(task), hidden);
    best.offer(task, 0.5 * hidden, "better");
    best.offer(task, 0.7 * hidden, "worse");
    best.save();
  }
  BestKnown again(file);
  EXPECT_NEAR(again.of(task), 0.5 * hidden, 1e-9 * hidden);
  {
    // two that keep to the same file at a time
    BestKnown first(file), second(file);
    first.offer(task, 0.4 * hidden, "first");
    first.save();
    second.offer(task, 0.45 * hidden, "second");
    second.offer(tasks()[1], 0.5 * tasks()[1].hidden_objective, "second");
    second.save();
  }
  again = BestKnown(file);
  EXPECT_NEAR(again.of(task), 0.4 * hidden, 1e-9 * hidden);
  EXPECT_NEAR(again.of(tasks()[1]), 0.5 * tasks()[1].hidden_objective, 1e-9 * tasks()[1].hidden_objective);
  // another task of that number, from a generator that has changed
  Task changed = task;
  changed.hidden_objective *= 1.5;
  EXPECT_EQ(again.of(changed), changed.hidden_objective);
}

}  // namespace
}  // namespace carom::bench
