// SPDX-License-Identifier: MIT
#include "editing/edit.h"

#include <chrono>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/detail/messages.hpp"
#include "editing/detail/thrown_by_user.hpp"
#include "editing/problem_of.hpp"
#include "editing/report/alternatives.hpp"
#include "editing/report/explain.hpp"
#include "editing/report/verify.hpp"
#include "editing/solve/minimise.hpp"
#include "editing/strategy/edit_solution.hpp"
#include "editing/strategy/least_squares_search.hpp"

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

Nail Edit::nail(const std::string& body, When at) & {
  nails_.push_back({next_id_, Constraint{body, std::move(at), {}}});
  return Nail(this, next_id_++);
}

Edit& Edit::hit(const std::string& body, Hit hit) & {
  nails_.push_back({next_id_++, Constraint{body, When(0.0), {}}});
  nails_.back().constraint.hits = std::move(hit);
  return *this;
}

Edit& Edit::hit(const std::string& body, const std::string& with) & { return hit(body, Hit{with}); }

Edit& Edit::sequence(std::vector<std::string> impacts) & {
  nails_.push_back({next_id_++, Constraint{"", When(0.0), {}}});
  nails_.back().constraint.sequence = std::move(impacts);
  return *this;
}

void Edit::unnail(const Nail& nail) {
  std::erase_if(nails_, [&](const Nailed& nailed) { return nailed.id == nail.id_; });
}

std::vector<Constraint> Edit::constraints() const {
  std::vector<Constraint> constraints;
  for (const Nailed& nailed : nails_) constraints.push_back(nailed.constraint);
  return constraints;
}

Edit& Edit::require(MotionFunction function, Wanted wanted) & {
  required_.emplace_back(std::move(function), wanted);
  return *this;
}

Edit& Edit::minimise(MotionFunction function, double change_weight) & {
  minimised_ = std::move(function);
  change_weight_ = change_weight;
  return *this;
}

EditProblem editing_detail::problemOf(const Edit& edit) {
  OwnFunctions own;
  for (const auto& [function, wanted] : edit.required_) own.rows.push_back({function, wanted});
  own.objective = edit.minimised_;
  own.change_weight = edit.change_weight_;
  return EditProblem(edit.scene_, edit.contacts_, edit.duration_, edit.controls_, edit.constraints(), own);
}

NlpEvaluator Edit::evaluator(std::size_t step_limit) const { return NlpEvaluator(problemOf(*this), step_limit); }

namespace {

/// Samples are numbered by an int.
constexpr int kLastSeed = 1000;

void checkEditOptions(const EditOptions& options) {
  const auto check = [](const char* name, double value, bool good, const char* expected) {
    if (!good) throw InputError(std::string("/options/") + name, "found " + number(value) + ", expected " + expected);
  };
  check("max_iterations", options.max_iterations, options.max_iterations >= 0, "0 or more");
  check("time_budget_seconds", options.time_budget_seconds, options.time_budget_seconds >= 0, "a number >= 0");
  check("tolerance", options.tolerance, options.tolerance > 0 && std::isfinite(options.tolerance), "a number > 0");
  check("graze_margin", options.graze_margin, options.graze_margin >= 0 && std::isfinite(options.graze_margin), "a number >= 0");
  check("seed", options.seed, options.seed >= 0 && options.seed <= kLastSeed, "0 to 1000");
  check("alternatives", options.alternatives, options.alternatives >= 1, "1 or more");
  check("threads", options.threads, options.threads >= 0, "0 (all cores) or more");
}

}  // namespace

EditResult Edit::solve(const EditOptions& options) const {
  checkEditOptions(options);
  try {
    return solved(options);
  } catch (const ThrownByUser& by_user) {
    std::rethrow_exception(by_user.thrown);
  } catch (...) {
    if (options.abandon && options.stop.stop_requested()) throw EditAbandoned();  // half a motion makes no sense to some
    throw;
  }
}

EditResult Edit::solved(const EditOptions& options) const {
  const auto began = std::chrono::steady_clock::now();
  EditProblem problem = problemOf(*this);
  problem.step_limit = options.step_limit;
  problem.stop = options.stop;
  if (options.abandon) problem.abandon = options.stop;
  endWhereNothingCounts(problem);
  EditEvaluator evaluator(problem, options);
  EditSolution solution = findSolution(evaluator);
  if (problem.constraints.objective() && solution.status == EditStatus::solved)
    solution.point = problem.isLeastSquares() ? smallestSquares(evaluator, solution.point) : lowerObjective(evaluator, solution.point);
  problem.leaveIfAbandoned();
  EditResult result = verify(scene_, evaluator, solution);
  problem.leaveIfAbandoned();
  if (options.explain) explainInto(result, scene_, evaluator, solution);
  // what stands against each other is said there, or else here
  if (result.why_not.sentences.empty() && !solution.contradiction.empty())
    result.message = solution.contradiction + " " + result.message;
  if (result.solved() && !evaluator.isCancelled()) result.alternatives = alternativesTo(scene_, evaluator, solution);
  problem.leaveIfAbandoned();
  if (evaluator.isCancelled()) endAsCancelled("its answer was completed", result);
  result.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  return result;
}

}  // namespace carom
