// SPDX-License-Identifier: MIT
#include "editing/edit.h"

#include <chrono>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/jacobian.hpp"
#include "editing/report/alternatives.hpp"
#include "editing/report/explain.hpp"
#include "editing/report/verify.hpp"
#include "editing/strategy/edit_solution.hpp"

namespace carom {
using namespace editing_detail;

Edit::Edit(const Scene& scene, ContactSource& contacts, double duration)
    : scene_(scene), contacts_(contacts), duration_(duration) {}

Edit::Edit(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
           std::vector<Constraint> constraints)
    : Edit(scene, contacts, duration) {
  controls_ = std::move(controls);
  for (Constraint& constraint : constraints) nails_.push_back({next_id_++, std::move(constraint)});
}

Nail Edit::nail(const std::string& body, When at) {
  nails_.push_back({next_id_, Constraint{body, std::move(at), {}}});
  return Nail(this, next_id_++);
}

void Edit::unnail(const Nail& nail) {
  std::erase_if(nails_, [&](const Nailed& nailed) { return nailed.id == nail.id_; });
}

std::vector<Constraint> Edit::constraints() const {
  std::vector<Constraint> constraints;
  for (const Nailed& nailed : nails_) constraints.push_back(nailed.constraint);
  return constraints;
}

EditProblem Edit::problem() const { return EditProblem(scene_, contacts_, duration_, controls_, constraints()); }

namespace {

void checkEditOptions(const EditOptions& options) {
  const auto check = [](const char* name, double value, bool good, const char* expected) {
    if (!good) throw InputError(std::string("/options/") + name, "found " + number(value) + ", expected " + expected);
  };
  check("max_iterations", options.max_iterations, options.max_iterations >= 0, "0 or more");
  check("time_budget_seconds", options.time_budget_seconds, options.time_budget_seconds >= 0, "a number >= 0");
  check("tolerance", options.tolerance, options.tolerance > 0 && std::isfinite(options.tolerance), "a number > 0");
  check("alternatives", options.alternatives, options.alternatives >= 1, "1 or more");
  check("threads", options.threads, options.threads >= 0, "0 (all cores) or more");
}

}  // namespace

EditResult Edit::solve(const EditOptions& options) const {
  checkEditOptions(options);
  const auto began = std::chrono::steady_clock::now();
  EditProblem problem = this->problem();
  problem.step_limit = options.step_limit;
  problem.stop = options.stop;
  problem.awaited = problem.constraints.awaited();
  problem.least_duration = problem.constraints.leastDuration();
  EditSearch search(problem, options);
  const EditSolution solution = findSolution(search);
  EditResult result = verify(scene_, search, solution);
  if (options.explain) explainInto(result, scene_, search, solution);
  if (result.solved() && search.halt() != Halt::cancelled) result.alternatives = alternativesTo(scene_, search, solution);
  result.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  return result;
}

}  // namespace carom
