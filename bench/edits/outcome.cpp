// SPDX-License-Identifier: MIT
#include "bench/edits/outcome.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <exception>
#include <limits>

#include "adjoint/simulate/simulate.h"
#include "bench/edits/checks.h"
#include "bench/edits/tables.h"
#include "editing/problem/edit_problem.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::bench {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

// Bounds may be met with rounding.
constexpr double kBoundSlack = 1e-9;

bool keepsBounds(const EditProblem& problem, const Eigen::VectorXd& values) {
  for (int i = 0; i < problem.controls.size(); ++i) {
    const Variable& v = problem.controls.variables()[static_cast<std::size_t>(i)];
    const double slack = kBoundSlack * (1 + std::abs(values[i]));
    if (!(values[i] >= v.lower - slack && values[i] <= v.upper + slack)) return false;
  }
  const Eigen::VectorXd validity = problem.validity.evaluate(problem.controls, values);
  return validity.size() == 0 || validity.minCoeff() >= -kBoundSlack;
}

Eigen::VectorXd valuesOf(const Task& task, ContactSource& contacts, const std::vector<ChangedNumber>& answer) {
  const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
  Eigen::VectorXd values = problem.controls.startValues();
  for (int i = 0; i < problem.controls.size(); ++i) values[i] = answer.at(static_cast<std::size_t>(i)).after;
  return values;
}

}  // namespace

void judge(const Task& task, ContactSource& contacts, const Eigen::VectorXd& values, Outcome& outcome) {
  const EditProblem problem(task.start, contacts, task.duration, task.controls, task.constraints);
  for (int i = 0; i < problem.controls.size(); ++i) {
    const double y = changeOf(problem.controls.variables()[static_cast<std::size_t>(i)], values[i]);
    outcome.objective += 0.5 * y * y;
  }
  outcome.residual = std::numeric_limits<double>::infinity();
  const Motion motion = simulate(problem.controls.sceneAt(values), contacts, task.duration);
  const RowValues rows = problem.constraints.evaluate(motion);
  if (rows.available) outcome.residual = largestMiss(rows);
  outcome.met =
      outcome.residual <= kLargestResidual && keepsBounds(problem, values) && beginsWith(motion, task.sequence);
}

Outcome solve(const Task& task, const Configuration& configuration, double budget_seconds) {
  using Clock = std::chrono::steady_clock;
  Outcome outcome;
  outcome.residual = std::numeric_limits<double>::infinity();
  try {
    OdeContacts contacts(task.start);
    const Edit edit(task.start, contacts, task.duration, task.controls, task.constraints);
    EditOptions options = configuration.options;
    options.time_budget_seconds = budget_seconds;
    const std::clock_t cpu_began = std::clock();
    const auto began = Clock::now();
    const EditResult result = edit.solve(options);
    outcome.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    outcome.cpu_milliseconds = 1e3 * static_cast<double>(std::clock() - cpu_began) / CLOCKS_PER_SEC;
    outcome.status = result.status;
    outcome.message = result.message;
    outcome.iterations = result.iterations;
    outcome.claimed = result.solved();
    outcome.sequence_changed = result.signature_changed;
    judge(task, contacts, valuesOf(task, contacts, result.changed), outcome);
  } catch (const std::exception& error) {
    outcome.met = outcome.claimed = false;
    outcome.message = std::string("an exception: ") + error.what();
  }
  return outcome;
}

}  // namespace carom::bench
