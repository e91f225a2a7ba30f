// SPDX-License-Identifier: MIT
#include "editing/session/session_solver.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/solve/least_squares.hpp"
#include "editing/solve/minimise.hpp"
#include "editing/strategy/edit_solution.hpp"

namespace carom::editing_detail {
namespace {

/// From this share of the duration on all of it is simulated, so that the motion to show is there already.
constexpr double kNearlyAll = 0.8;
/// What a nail is worth against the goal while neither is met.
constexpr double kNailWeight = 10;

/// Motions of a problem end early once a stop is requested.
class Interruptible {
 public:
  Interruptible(EditProblem& problem, const std::stop_token& stop) : problem_(problem) { problem_.stop = stop; }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
  ~Interruptible() { problem_.stop = {}; }

 private:
  EditProblem& problem_;
};

/// A goal is come to as near as may be, whether or not its constraint is soft.
std::vector<Constraint> withoutWeight(std::vector<Constraint> constraints, int goal) {
  if (goal >= 0) constraints[static_cast<std::size_t>(goal)].soft.reset();
  return constraints;
}

}  // namespace

SessionSolver::SessionSolver(const Scene& reference, ContactSource& contacts, double duration,
                             const std::vector<Control>& controls, const std::vector<Constraint>& constraints, int goal,
                             const Eigen::VectorXd& changes, const SessionOptions& options, bool part)
    : options_(options),
      problem_(reference, contacts, duration, controls, withoutWeight(constraints, goal)),
      goal_(goal),
      lower_(problem_.lower()),
      upper_(problem_.upper()),
      until_(problem_.horizon),
      is_part_(part),
      stays_whole_(part || !problem_.soft.empty()) {
  // Motions are shown as well: whoever turns is to be seen turning.
  for (Asked& asked : problem_.asked) asked.orientation = true;
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(problem_.unknowns());
  if (changes.size() > 0) unknowns.head(problem_.controls.size()) = changes;
  start_ = point_ = pointAt(problem_, unknowns, until_, true);
  if (!point_->rows.available)
    throw InputError("found a constraint that the motion cannot evaluate, expected one that it can: " + point_->rows.message);
  if (!problem_.constraints.holdsAtRest())
    until_ = std::min(until_, kMarginAfterLast * problem_.constraints.extentIn(point_->motion).time);
  if (!is_part_ && until_ > kNearlyAll * duration) until_ = duration;
  nails_allowed_ = std::max(options_.tolerance, nailViolation(*point_));
}

/// Null where the motion would take far longer than that of the start.
EditPointPtr SessionSolver::evaluate(const Eigen::VectorXd& changes) const {
  MotionMaker maker;
  maker.how.step_limit = mostStepsBeside(*start_);
  const EditPointPtr point = trialAt(problem_, changes, until_, false, maker);
  return point && point->motion.status == MotionStatus::step_limit ? nullptr : point;
}

/// A motion that may be shown takes as long as it takes.
EditPointPtr SessionSolver::evaluateToShow(const Eigen::VectorXd& changes) const {
  MotionMaker maker;
  maker.how.baseline = known_.get();
  return trialAt(problem_, changes, until_, false, maker);
}

void SessionSolver::aim(int target, const std::vector<TargetNumber>& value) {
  Target moved = problem_.constraints.constraints()[static_cast<std::size_t>(goal_)].targets[static_cast<std::size_t>(target)];
  moved.value = value;
  aim(target, moved);
}

void SessionSolver::aim(int target, const Target& moved) {
  problem_.constraints.setTarget(goal_, target, moved);
  // Errors are other ones; derivatives of places are the same, those of a turn depend on where it is to end.
  const std::vector<Row>& rows = problem_.constraints.rows();
  const bool turns = std::any_of(rows.begin(), rows.end(), [&](const Row& row) {
    return row.constraint == goal_ && row.target_index == target && row.kind && row.kind->from_target;
  });
  for (const EditPointPtr& point : {start_, point_}) {
    readRows(problem_, *point);
    if (turns) point->row_jacobian.reset();
  }
  if (part_) part_->aim(target, moved);
}

double SessionSolver::nailError(const RowValues& rows) const {
  double error = 0;
  for (int i = 0; i < problem_.constraints.size(); ++i)
    if (problem_.constraints.rows()[static_cast<std::size_t>(i)].constraint != goal_)
      error = std::max(error, std::abs(rows.scaled[i]));
  return error;
}

double SessionSolver::nailViolation(const EditPoint& point) const {
  const double invalid = point.validity.size() > 0 ? std::max(0.0, -point.validity.minCoeff()) : 0;
  return std::max(invalid, nailError(point.rows));
}

double SessionSolver::merit(const EditPoint& point) const {
  double squares = 0;
  for (int i = 0; i < problem_.constraints.size(); ++i)
    if (problem_.constraints.rows()[static_cast<std::size_t>(i)].constraint == goal_)
      squares += point.rows.scaled[i] * point.rows.scaled[i];
  return kNailWeight * nailViolation(point) + std::sqrt(squares);
}

/// Nails first, then the goal, then the change.
bool SessionSolver::isBetter(const EditPoint& point) const {
  if (reached(point) && reached()) return point.objective < point_->objective;
  const double nails = std::max(nails_allowed_, nailViolation(point));
  const double nails_so_far = std::max(nails_allowed_, nailViolation(*point_));
  if (nails != nails_so_far) return nails < nails_so_far;
  return goal_ < 0 ? nailViolation(point) < nailViolation(*point_) : merit(point) < merit(*point_);
}

void SessionSolver::keepIfBetter(const EditPointPtr& point) {
  if (!isBetter(*point)) return;
  point_ = point;
  nails_allowed_ = std::clamp(nailViolation(*point), options_.tolerance, nails_allowed_);
  if (better_) better_();
}

/// Where the budget ends, what counts is the best that the search had when work was counted last: what came after that
/// depends on when it was interrupted.
void SessionSolver::finishHere(Budget& budget) {
  if (!budget.pass()) return;
  EditOptions options;
  options.max_iterations = options_.release_iterations;
  options.tolerance = options_.tolerance;
  options.sequence = options_.sequence;
  EditPointPtr found, counted;
  {
    const Interruptible motions(problem_, budget.stop());
    options.stop = budget.stop();
    EditEvaluator evaluator(problem_, options);
    options.progress = [&](const EditProgress&) {
      if (!budget.take()) return false;
      counted = evaluator.best();
      return !budget.expired() && evaluator.work() < options_.release_steps;
    };
    if (!reached()) {
      found = findSolution(evaluator).point;
    } else if (const EditPointPtr from = evaluator.evaluate(point_->changes)) {
      found = problem_.isLeastSquares() ? from : minimiseWithin(evaluator, from, evaluator.iterationsLeft());
    }
    if (found && problem_.isLeastSquares() && reached(*found))
      found = minimiseLeastSquares(evaluator, found, evaluator.iterationsLeft());
    iterations_ += evaluator.iterations();
  }
  if (!budget.pass()) found = counted;
  if (!found || !found->rows.available || !reached(*found)) return;
  if (options_.sequence == SequencePolicy::stay && found->signature != start_->signature) return;
  if (const EditPointPtr again = evaluateToShow(found->changes)) keepIfBetter(again);
}

}  // namespace carom::editing_detail
