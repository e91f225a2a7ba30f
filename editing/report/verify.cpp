// SPDX-License-Identifier: MIT
#include "editing/report/verify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/derivative/adjoint.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/jacobian.hpp"
#include "editing/report/certify.hpp"
#include "editing/report/constrained_numbers.hpp"
#include "editing/report/fit.hpp"

namespace carom::editing_detail {
namespace {

std::vector<ChangedNumber> changesOf(const ControlSet& controls, const EditPoint& point) {
  const Eigen::VectorXd costs = point.changes.head(controls.size()).cwiseAbs2();
  const double all = costs.sum();
  std::vector<ChangedNumber> changed;
  for (int i = 0; i < controls.size(); ++i) {
    const Variable& v = controls.variables()[i];
    changed.push_back({v.control, controls.describeVariable(i), v.component, v.before, point.values[i],
                       all > 0 ? costs[i] / all : 0});
  }
  return changed;
}

std::vector<MetTime> metTimes(const ConstraintSet& constraints, const Motion& motion, const RowValues& rows) {
  std::vector<MetTime> times;
  for (const ConstrainedTime& time : constraints.constrainedTimes(motion, rows.times))
    times.push_back({time.constraint, constraints.describeConstraint(time.constraint), time.from, time.to, time.time});
  for (int i = 0; i < static_cast<int>(constraints.constraints().size()); ++i) {
    const Constraint& constraint = constraints.constraints()[static_cast<std::size_t>(i)];
    if (!requiresImpacts(constraint)) continue;
    if (const auto time = constraints.timeOfAwaited(motion, i))
      times.push_back({i, constraint.hits ? "'" + constraint.body + "' hits '" + constraint.hits->with + "'" : constraints.describeConstraint(i),
                       0, motion.end, *time});
  }
  return times;
}

/// Largest magnitude; NaN if any entry is.
double largest(const Eigen::VectorXd& values) {
  double most = 0;
  for (double value : values) most = std::isnan(value) ? value : std::max(most, std::abs(value));
  return values.hasNaN() ? std::numeric_limits<double>::quiet_NaN() : most;
}

/// Of the derivatives of all rows, the worst.
Reliability reliabilityOf(const EditProblem& problem, const Motion& motion, const RowValues& rows) {
  Reliability worst;
  DerivativeTape tape(motion, problem.leaver());
  const auto take = [&](const std::vector<StateSeed>& seeds, const std::string& why) {
    if (seeds.empty()) return;
    Reliability one;
    adjoint(tape, seeds, &one);
    askControls(problem.controls, one);
    doubt(why, one);
    worst.events = std::max(worst.events, one.events);
    worst.smallest_margin = std::min(worst.smallest_margin, one.smallest_margin);
    if (worst.reliable && !one.reliable) worst.message = one.message;
    worst.reliable = worst.reliable && one.reliable;
  };
  for (std::size_t i = 0; i < rows.seeds.size(); ++i) take(rows.seeds[i], rows.notes[i].doubt);
  if (rows.objective) take(rows.objective->seeds, rows.objective->doubt);
  return worst;
}

/// The first few of those that matter, in sentences.
std::string sentencesOf(const std::vector<SequenceChange>& changes) {
  constexpr int kMost = 4;
  std::string text;
  int count = 0;
  for (const SequenceChange& change : changes)
    if (change.matters && ++count <= kMost) text += " " + change.sentence;
  const char* more = count == kMost + 1 ? " more difference.)" : " more differences.)";
  if (count > kMost) text += " (" + std::to_string(count - kMost) + more;
  return text;
}

/// The impacts of the result beside those of the scene as written; `motion` is of that. The start of the search is that
/// scene too, unless its bounds moved it.
void compareImpacts(const EditProblem& problem, const EditSolution& solution, const Motion& motion,
                    EditResult& result) {
  const Eigen::VectorXd times = problem.controls.startMoved() ? Eigen::VectorXd() : solution.start->rows.times;
  const ConstraintSet::Extent is = problem.constraints.extentIn(result.motion, solution.point->rows.times);
  // Where the motion before lacks an impact that is held, it has no last constraint: it is compared up to the same time.
  std::size_t held_before = problem.constraints.extentIn(motion, times).events;
  if (!problem.constraints.hasAllAwaited(motion))
    held_before = static_cast<std::size_t>(std::count_if(motion.events.begin(), motion.events.end(),
                                                         [&](const Event& event) { return event.time <= is.time; }));
  result.sequence_changes = wholeSequenceChanges(motion, held_before, result.motion, is.events);
  result.signature_changed = std::any_of(result.sequence_changes.begin(), result.sequence_changes.end(),
                                         [](const SequenceChange& c) { return c.matters; });
  result.sequence_before = motion.describeEvents();
  result.sequence_after = result.motion.describeEvents();
}

/// Fills in everything that is read from the motion of result.scene.
void readMotion(const EditProblem& problem, const Eigen::VectorXd& times, EditResult& result) {
  const RowValues rows = problem.constraints.evaluate(result.motion, times);
  result.residuals = constrainedNumbers(problem.constraints, rows);
  result.times = metTimes(problem.constraints, result.motion, rows);
  if (!problem.soft.empty())
    for (const MetTime& time : metTimes(problem.soft.set(), result.motion, problem.soft.evaluate(result.motion)))
      result.times.push_back(time);
  result.residual = largest(rows.residuals);
  result.scaled_residual = largest(rows.scaled);
  result.reliability = reliabilityOf(problem, result.motion, rows);
}

/// A scene that stays as written need not say its numbers in the words of the controls: then it is put into them.
Certificate certificateOf(const EditProblem& problem, const EditPoint& point, bool untouched, const Motion& motion) {
  const auto of = [&](const Motion& m) {
    return certify(problem, point.changes, m, problem.constraints.evaluate(m, problem.timesOf(point.changes)));
  };
  if (!untouched) return of(motion);
  return of(simulateScene(problem, problem.controls.sceneAt(point.values), problem.duration));
}

/// Where rounding alone moves the constraints by more than they may be off; else empty.
std::string roundingSentence(double growth, double tolerance) {
  const double rounding = growth * std::numeric_limits<double>::epsilon();
  if (!(rounding > tolerance)) return "";
  return " Small changes grow " + brief(growth) + "-fold up to the constraints, so that rounding alone moves them by " +
         brief(rounding) + " of the natural scales.";
}

void conclude(const EditOptions& options, const EditSolution& solution, bool as_it_was, bool least_squares, EditResult& result) {
  result.status = solution.status;
  result.message = solution.message;
  if (solution.status != EditStatus::solved) return;
  // Written so that a NaN does not pass.
  if (!(result.scaled_residual <= options.tolerance)) {
    result.status = EditStatus::not_converged;
    result.message = "The solution was not confirmed by a new simulation: it misses by " +
                     brief(result.scaled_residual) + " of the natural scales.";
    return;
  }
  result.met = true;
  const bool unchanged = as_it_was && result.iterations == 0;
  if (result.residuals.empty() && least_squares)
    result.message = "The change and the errors of the soft constraints are least.";
  else
    result.message = unchanged ? "The initial motion already meets all constraints."
                               : "All constraints are met, the largest error is " + brief(result.residual) + ".";
  if (result.signature_changed) {
    result.status = EditStatus::solved_sequence_changed;
    result.message += " The impact sequence has changed." + sentencesOf(result.sequence_changes);
  }
  if (!solution.message.empty()) result.message += " " + solution.message;
  if (!result.reliability.reliable) result.message += " Its derivatives are unreliable: " + result.reliability.message + ".";
}

}  // namespace

std::vector<ConstrainedNumber> constrainedNumbers(const ConstraintSet& constraints, const RowValues& rows) {
  std::vector<ConstrainedNumber> numbers;
  for (int i = 0; i < constraints.size(); ++i) {
    const Row& row = constraints.rows()[i];
    numbers.push_back({row.constraint, constraints.describeRow(i), row.name, rows.values[i], row.target, rows.residuals[i],
                       rows.scaled[i], row.lower, row.upper});
  }
  return numbers;
}

void endAsCancelled(const std::string& meanwhile, EditResult& result) {
  if (!result.solved()) return;
  result.status = EditStatus::cancelled;
  result.message += " It was cancelled while " + meanwhile + ".";
}

EditResult verify(const Scene& written, const EditEvaluator& evaluator, const EditSolution& solution) {
  const EditProblem& problem = evaluator.problem();
  const EditPoint& point = *solution.point;
  EditResult result;
  const bool as_it_was = problem.change(point.changes) == 0;
  const bool untouched = as_it_was && !problem.controls.startMoved();
  result.scene = untouched ? written : problem.controls.sceneAt(point.values);
  result.changed = changesOf(problem.controls, point);
  result.objective = point.objective;
  result.iterations = evaluator.iterations();
  result.motion = simulateScene(problem, result.scene, problem.duration);
  if (untouched) {
    compareImpacts(problem, solution, result.motion, result);
  } else {
    compareImpacts(problem, solution, simulateScene(problem, written, problem.duration), result);
  }
  readMotion(problem, problem.timesOf(point.changes), result);
  if (evaluator.options().certify && !evaluator.isCancelled()) {
    Certificate& certificate = result.certificate = certificateOf(problem, point, untouched, result.motion);
    certificate.residual = result.residual;
    certificate.scaled_residual = result.scaled_residual;
    certificate.reliability = result.reliability;
  }
  conclude(evaluator.options(), solution, as_it_was, problem.isLeastSquares(), result);
  fitInto(result, evaluator, solution.point);
  if (evaluator.halt() == Halt::cancelled) endAsCancelled("it looked for a smaller change", result);
  result.growth = solution.growth;
  if (!result.solved()) result.message += roundingSentence(result.growth, evaluator.options().tolerance);
  for (const std::string& note : problem.controls.notes()) result.message += " " + note;
  return result;
}

}  // namespace carom::editing_detail
