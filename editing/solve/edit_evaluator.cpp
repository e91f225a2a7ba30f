// SPDX-License-Identifier: MIT
#include "editing/solve/edit_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "editing/problem/jacobian.hpp"

namespace carom::editing_detail {
namespace {

constexpr std::size_t kRecentPoints = 4;
/// No number is followed further than this, in natural scales: where constraints are in conflict steps may
/// lead to any speed and spin, and so to motions of any cost.
constexpr double kFarthest = 1e3;
/// Steps of the motion of a trial: so many, or so many times those of the start. Some trials bounce to and fro in a
/// corner for a hundred times the work of all others.
constexpr std::size_t kLeastSteps = 2000, kStepsOfStart = 20;
/// What a point takes beside its motion, and what a reverse pass takes, in steps of a simulation: least squares over
/// the times of 660 edits.
constexpr std::size_t kStepsOfPoint = 17, kStepsOfPass = 6;

}  // namespace

EditEvaluator::EditEvaluator(const EditProblem& problem, const EditOptions& options)
    : problem_(problem),
      options_(options),
      budget_(options.max_iterations, options.time_budget_seconds, options.stop),
      lower_(problem.lower()),
      upper_(problem.upper()),
      until_(problem.horizon) {}

bool EditEvaluator::step(double objective, double violation) {
  budget_.count(1);
  if (budget_.expired()) return false;
  if (!silent_ && options_.progress && !options_.progress({iterations(), objective, violation}))
    budget_.end(Halt::cancelled);
  return halt() == Halt::none;
}

void readRows(const EditProblem& problem, EditPoint& point) {
  point.rows = problem.constraints.evaluate(point.motion, problem.timesOf(point.changes));
  point.violation = 0;
  for (double residual : point.rows.scaled) point.violation = std::max(point.violation, std::abs(residual));
  for (double h : point.validity) point.violation = std::max(point.violation, -h);
  if (!point.rows.available) point.violation = std::numeric_limits<double>::infinity();
  point.objective = problem.objective(point.changes, point.rows);
}

EditPointPtr pointAt(const EditProblem& problem, const Eigen::VectorXd& unknowns, double until, bool nearest_times,
                     const MotionMaker& maker) {
  auto point = std::make_shared<EditPoint>();
  point->changes = unknowns;
  point->values = problem.valuesOf(unknowns);
  if (maker.like) {
    MotionAlong along = simulateAlong(problem, point->values, maker.like->motion, until, maker.how.contacts);
    if (!along.complete) return nullptr;
    point->motion = std::move(along.motion);
  } else {
    point->motion = simulateAt(problem, point->values, until, maker.how);
  }
  if (nearest_times && problem.times() > 0)
    point->changes.tail(problem.times()) = problem.unknownTimes(problem.constraints.nearestTimes(point->motion));
  point->validity = problem.validity.evaluate(problem.controls, point->values);
  readRows(problem, *point);
  point->signature = point->motion.signature(problem.constraints.extentIn(point->motion, point->rows.times).events);
  return point;
}

EditPointPtr trialAt(const EditProblem& problem, const Eigen::VectorXd& unknowns, double until, bool nearest_times,
                     const MotionMaker& maker) {
  if (!unknowns.allFinite()) return nullptr;
  EditPointPtr point;
  try {
    point = pointAt(problem, unknowns, until, nearest_times, maker);
    if (point && !point->rows.available && until < problem.horizon)
      point = pointAt(problem, unknowns, problem.horizon, nearest_times, maker);
  } catch (const InputError&) {
    return nullptr;
  }
  if (maker.keep_lacking && point && !point->rows.lacking.empty()) return point;
  return point && point->rows.available && point->rows.scaled.allFinite() ? point : nullptr;
}

std::size_t mostStepsBeside(const EditPoint& start) { return std::max(kLeastSteps, kStepsOfStart * start.motion.steps); }

EditPointPtr EditEvaluator::evaluateStart() {
  EditPointPtr point = pointAt(problem_, Eigen::VectorXd::Zero(problem_.unknowns()), until_, true);
  consider(point);
  step_limit_ = mostStepsBeside(*point);
  if (!point->rows.available) return point;
  if (!problem_.stop_when && !problem_.constraints.holdsAtRest())
    until_ = std::min(problem_.horizon, kMarginAfterLast * problem_.constraints.extentIn(point->motion).time);
  recent_.push_back(point);
  return point;
}

EditPointPtr EditEvaluator::make(const Eigen::VectorXd& changes, bool nearest_times, const MotionMaker& maker) const {
  const Eigen::Index n = problem_.controls.size();
  if (n > 0 && changes.head(n).cwiseAbs().maxCoeff() > kFarthest) return nullptr;
  MotionMaker limited = maker;
  limited.how.step_limit = std::min(maker.how.step_limit, step_limit_);
  EditPointPtr point = trialAt(problem_, changes, until_, nearest_times, limited);
  work_->fetch_add(kStepsOfPoint + (point ? point->motion.steps : 0), std::memory_order_relaxed);
  return point;
}

bool EditEvaluator::differentiate(EditPoint& point) const {
  if (!point.row_jacobian) countPasses(static_cast<std::size_t>(problem_.constraints.size()));
  return editing_detail::differentiate(problem_, point);
}

void EditEvaluator::countPasses(std::size_t passes) const {
  work_->fetch_add(kStepsOfPass * passes, std::memory_order_relaxed);
}

EditPointPtr EditEvaluator::evaluate(const Eigen::VectorXd& changes, bool nearest_times) {
  for (const EditPointPtr& point : recent_) {
    if (!nearest_times && point->changes == changes) return point;
  }
  if (budget_.expired()) return nullptr;
  const EditPointPtr point = make(changes, nearest_times, maker_);
  if (!point) return nullptr;
  if (recent_.size() == kRecentPoints) recent_.erase(recent_.begin());
  recent_.push_back(point);
  consider(point);
  return point;
}

void EditEvaluator::allowLongerMotions() {
  constexpr std::size_t kMore = 2;
  step_limit_ *= step_limit_ < std::numeric_limits<std::size_t>::max() / kMore ? kMore : 1;
}

EditEvaluator EditEvaluator::branch(const MotionMaker& maker, bool silent) const {
  EditEvaluator other(*this);
  other.maker_ = maker;
  other.silent_ = silent;
  other.recent_.clear();
  other.best_ = nullptr;
  return other;
}

bool differentiate(const EditProblem& problem, EditPoint& point) {
  if (point.row_jacobian) return point.row_jacobian->allFinite();
  const Eigen::VectorXd rates = problem.rates(point.changes);
  const Eigen::Index n = problem.controls.size(), k = problem.times();
  Eigen::MatrixXd J(problem.constraints.size(), n + k);
  try {
    J.leftCols(n) = jacobianByAdjoint(problem, point.values, point.motion, point.rows);
  } catch (const NotComputable& why) {
    point.not_computable = why.what();
    J.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  J.rightCols(k) = jacobianByTimes(problem, point.motion, point.rows);
  J *= rates.asDiagonal();
  const std::vector<Row>& rows = problem.constraints.rows();
  for (Eigen::Index i = 0; i < J.rows(); ++i) J.row(i) /= rows[i].scale;
  point.row_jacobian = std::move(J);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(problem.validity.size(), n + k);
  H.leftCols(n) = problem.validity.jacobian(problem.controls, point.values) * rates.head(n).asDiagonal();
  point.validity_jacobian = std::move(H);
  return point.row_jacobian->allFinite();
}

void differentiateObjective(const EditProblem& problem, EditPoint& point) {
  const BoundFunction* own = problem.constraints.objective();
  if (!own || point.objective_gradient) return;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(problem.unknowns());
  gradient.head(problem.controls.size()) =
      problem.controls.gather(adjoint(point.motion, point.rows.objective->seeds), point.values) / own->function.scale;
  point.objective_gradient = gradient.cwiseProduct(problem.rates(point.changes));
}

void EditEvaluator::consider(const EditPointPtr& point) {
  if (best_) {
    if (options_.sequence == SequencePolicy::stay && point->signature != best_->signature) return;
    const bool both = reached(*point) && reached(*best_);
    const bool better = both ? point->objective < best_->objective : point->violation < best_->violation;
    if (!better) return;
  }
  best_ = point;
}

}  // namespace carom::editing_detail
