// SPDX-License-Identifier: MIT
#include "editing/solve/least_squares.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/problem/jacobian.hpp"
#include "editing/solve/bounded_least_squares.hpp"
#include "editing/solve/projection.hpp"

namespace carom::editing_detail {
namespace {

/// Damping, as a share of the squares of the columns: at first, what it is multiplied by after a step that fails, and after
/// one that succeeds, and its range.
constexpr double kFirstDamping = 1e-4, kFailed = 8, kSucceeded = 0.1, kLeast = 1e-12, kLastDamping = 1e8;
/// What rows that are held weigh beside the objective in a step, which is brought onto them afterwards.
constexpr double kHeldWeight = 1e5;
/// A range or validity that a step leaves by more than this is held in another try.
constexpr double kLeaves = 1e-12;
/// The steps end where one would lower the objective by no more than this share, to second order.
constexpr double kNothingLeft = 1e-14;
/// A step of no more than this share of the change is taken then, if the objective is the same to rounding.
constexpr double kLastStep = 1e-5;
/// Steps back onto the constraints.
constexpr int kBackOnto = 6;

void addHeld(const Eigen::RowVectorXd& gradient, double residual, LeastSquaresModel& model) {
  const double norm = gradient.norm(), length = norm > 0 ? norm : 1;
  model.J.conservativeResize(model.J.rows() + 1, gradient.size());
  model.h.conservativeResize(model.J.rows());
  model.J.bottomRows<1>() = gradient / length;
  model.h[model.h.size() - 1] = residual / length;
}

/// The minimum of the model with so much damping, within the bounds.
Eigen::VectorXd stepOf(const EditEvaluator& evaluator, const EditPoint& point, const LeastSquaresModel& model, double damping) {
  const Eigen::Index n = point.changes.size(), controls = evaluator.problem().controls.size();
  const Eigen::Index m = model.S.rows(), held = model.J.rows();
  const double weight = kHeldWeight * (1 + model.S.norm());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(m + n + n + held, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
  A.topRows(m) = model.S, b.head(m) = model.r;
  for (Eigen::Index j = 0; j < n; ++j) {
    const double of_change = j < controls ? 1 : 0;
    A(m + j, j) = of_change, b[m + j] = of_change * point.changes[j];
    A(m + n + j, j) = std::sqrt(damping * (1 + model.S.col(j).squaredNorm()));
  }
  A.bottomRows(held) = weight * model.J, b.tail(held) = weight * model.h;
  return boundedLeastSquares(A, b, evaluator.lower() - point.changes, evaluator.upper() - point.changes);
}

/// Ranges that a step leaves, beside those that are held already; whether there are more.
bool holdWhatIsLeft(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& step, std::vector<int>& held) {
  const std::vector<int>& ranges = evaluator.problem().constraints.ranges();
  if (ranges.empty()) return false;
  const Eigen::VectorXd after = residualsAfter(evaluator, point, step);
  const std::size_t before = held.size();
  for (const int i : ranges)
    if (std::abs(after[i]) > kLeaves && std::find(held.begin(), held.end(), i) == held.end()) held.push_back(i);
  return held.size() > before && held.size() <= static_cast<std::size_t>(step.size());
}

/// By how much the objective falls along a step, to second order.
double gainOf(const EditProblem& problem, const EditPoint& point, const LeastSquaresModel& model, const Eigen::VectorXd& step) {
  const Eigen::Index n = problem.controls.size();
  const Eigen::VectorXd r = model.r + model.S * step, z = (point.changes + step).head(n);
  return 0.5 * (model.r.squaredNorm() - r.squaredNorm() + point.changes.head(n).squaredNorm() - z.squaredNorm());
}

/// Leaves out the errors that are read later than `until`, or at an event.
void cutAt(double until, const SoftTerms& soft, LeastSquaresModel& model) {
  if (std::isinf(until)) return;
  for (int i = 0; i < soft.set().size(); ++i) {
    const Row& row = soft.set().rows()[static_cast<std::size_t>(i)];
    const When& at = soft.set().constraints()[static_cast<std::size_t>(row.constraint)].at;
    if (const auto last = recordedUntil(row, at); last && *last <= until) continue;
    model.r[i] = 0;
    model.S.row(i).setZero();
  }
}

/// The point at the end of a step, back on the constraints; null where there is none.
EditPointPtr takeStep(EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& step) {
  const Eigen::VectorXd to = (point.changes + step).cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper());
  EditPointPtr trial = evaluator.evaluate(to);
  if (trial && !evaluator.reached(*trial)) trial = projectOntoConstraints(evaluator, trial, kBackOnto);
  return trial && evaluator.reached(*trial) ? trial : nullptr;
}

/// The end of the last step, whose gain is below the rounding of the objective; the point itself where it is none.
EditPointPtr stationary(EditEvaluator& evaluator, const EditPointPtr& point, const Eigen::VectorXd& step, double objective, double until) {
  if (step.norm() > kLastStep * (1 + point->changes.norm())) return point;
  const EditPointPtr end = takeStep(evaluator, *point, step);
  return end && objectiveUntil(until, evaluator.problem(), *end) <= (1 + kNothingLeft) * objective ? end : point;
}

}  // namespace

std::optional<double> recordedUntil(const Row& row, const When& at) {
  if (row.overSpan() || !(at.isTime() || at.span)) return std::nullopt;
  return at.span ? at.span->second : at.time;
}

double objectiveUntil(double until, const EditProblem& problem, const EditPoint& point) {
  if (std::isinf(until)) return point.objective;
  LeastSquaresModel errors;
  errors.r = problem.soft.weighted(problem.soft.evaluate(point.motion));
  errors.S.resize(errors.r.size(), 0);
  cutAt(until, problem.soft, errors);
  return 0.5 * errors.r.squaredNorm() + problem.change(point.changes);
}

LeastSquaresModel leastSquaresModel(const EditProblem& problem, EditPoint& point, const std::vector<int>& held_ranges, double until) {
  LeastSquaresModel model;
  const RowValues soft = problem.soft.evaluate(point.motion);
  model.r = problem.soft.weighted(soft);
  model.S = softJacobian(problem, point.changes, point.motion, soft);
  cutAt(until, problem.soft, model);
  model.J.resize(0, point.changes.size());
  if (!differentiate(problem, point)) throw NotComputable(point.not_computable);
  for (const int i : problem.constraints.equations()) addHeld(point.row_jacobian->row(i), point.rows.scaled[i], model);
  for (const int i : held_ranges) {
    const Row& row = problem.constraints.rows()[static_cast<std::size_t>(i)];
    const double value = point.rows.values[i];
    const double limit = std::abs(value - row.lower) < std::abs(value - row.upper) ? row.lower : row.upper;
    addHeld(point.row_jacobian->row(i), (value - limit) / row.scale, model);
  }
  for (Eigen::Index i = 0; i < point.validity.size(); ++i)
    if (point.validity[i] < kValidityMargin) addHeld(point.validity_jacobian->row(i), point.validity[i] - kValidityMargin, model);
  return model;
}

EditPointPtr minimiseLeastSquares(EditEvaluator& evaluator, EditPointPtr point, int max_steps, double until) {
  const EditProblem& problem = evaluator.problem();
  double objective = objectiveUntil(until, problem, *point);
  double damping = kFirstDamping;
  try {
    for (int k = 0; k < max_steps && evaluator.goesOn(); ++k) {
      std::vector<int> held;
      const LeastSquaresModel free = leastSquaresModel(problem, *point, held, until);
      EditPointPtr next;
      while (!next && damping <= kLastDamping && evaluator.halt() == Halt::none) {
        LeastSquaresModel model = free;
        Eigen::VectorXd step = stepOf(evaluator, *point, model, damping);
        for (held.clear(); holdWhatIsLeft(evaluator, *point, step, held);) {
          model = leastSquaresModel(problem, *point, held, until);
          step = stepOf(evaluator, *point, model, damping);
        }
        if (!(gainOf(problem, *point, model, step) > kNothingLeft * objective)) return stationary(evaluator, point, step, objective, until);
        next = takeStep(evaluator, *point, step);
        const double there = next ? objectiveUntil(until, problem, *next) : objective;
        if (!(there < objective)) next = nullptr;
        objective = std::min(objective, there);
        damping *= next ? kSucceeded : kFailed;
      }
      if (!next) break;
      damping = std::max(damping, kLeast);
      point = std::move(next);
      if (!evaluator.step(point->objective, point->violation)) break;
    }
  } catch (const NotComputable&) {  // steps end where there are no derivatives
  }
  return point;
}

}  // namespace carom::editing_detail
