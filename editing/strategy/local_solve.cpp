// SPDX-License-Identifier: MIT
#include "editing/strategy/local_solve.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "adjoint/numeric/decompositions.hpp"
#include "editing/solve/projection.hpp"
#include "editing/solve/reduced_hessian.hpp"
#include "editing/strategy/missing_impacts.hpp"

namespace carom::editing_detail {
namespace {

/// Where no step makes the merit smaller, steps across boundaries may: so many where a solution is known already.
constexpr int kLeapingSteps = 5;
/// Shares of the way along the constraints that are tried.
constexpr double kSharesAlong[] = {1, 0.3, 0.1};
/// A step after which more than this share of the residuals is left, or they are larger, went along bent rows.
constexpr double kBent = 0.1;
/// So near to the smallest change, as a share of it, steps gain less than the rounding of rows may hide in the merit: those
/// count that leave clearly less of the way.
constexpr double kFlat = 1e-3, kNearer = 0.5;
/// The penalty of the merit function, in multipliers.
constexpr double kAboveMultipliers = 2;

/// The rows and their linear model, as they were at other unknowns.
EditPoint linearAt(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& changes) {
  const ConstraintSet& constraints = evaluator.problem().constraints;
  const Eigen::VectorXd way = changes - point.changes;
  EditPoint seen;
  seen.changes = changes;
  seen.rows.values = point.rows.values;
  seen.rows.residuals = seen.rows.scaled = Eigen::VectorXd::Zero(constraints.size());
  const Eigen::VectorXd moved = *point.row_jacobian * way;
  for (int i = 0; i < constraints.size(); ++i) {
    const double scale = constraints.rows()[static_cast<std::size_t>(i)].scale;
    seen.rows.values[i] += moved[i] * scale;
    seen.rows.residuals[i] = constraints.residual(i, seen.rows.values[i]);
    seen.rows.scaled[i] = seen.rows.residuals[i] / scale;
  }
  seen.validity = point.validity + *point.validity_jacobian * way;
  seen.row_jacobian = point.row_jacobian;
  seen.validity_jacobian = point.validity_jacobian;
  return seen;
}

/// Largest multiplier of the rows at the smallest change z of the linear rows: z = J^T m.
double largestMultiplier(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& smallest) {
  if (point.row_jacobian->rows() == 0) return 0;
  const Eigen::Index n = evaluator.problem().controls.size();
  const Eigen::MatrixXd J = point.row_jacobian->leftCols(n);
  Eigen::MatrixXd normal = J * J.transpose();
  normal.diagonal().array() += 1e-12 * std::max(normal.diagonal().maxCoeff(), 1e-300);
  const Eigen::VectorXd m = adjoint_detail::solveSymmetric(normal, J * smallest.head(n));
  return m.allFinite() ? m.lpNorm<Eigen::Infinity>() : 0;
}

double merit(const EditPoint& point, double penalty) {
  return point.objective + penalty * (point.rows.scaled.lpNorm<1>() - point.validity.cwiseMin(0).sum());
}

/// A trial brought nearer to the rows with the derivatives of the point that it comes from: the second-order correction
/// without which steps along bent rows have to be short (Maratos). Null where it cannot be simulated.
EditPointPtr corrected(EditEvaluator& evaluator, const EditPoint& point, const EditPoint& trial) {
  EditPoint seen;
  seen.changes = trial.changes, seen.rows = trial.rows, seen.validity = trial.validity;
  seen.row_jacobian = point.row_jacobian, seen.validity_jacobian = point.validity_jacobian;
  return evaluator.evaluate(trial.changes + smallestStep(evaluator, seen));
}

/// The first point along the steps with a smaller merit; null where there is none.
EditPointPtr stepAlong(EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& onto,
                       const Eigen::VectorXd& along, double penalty, const std::string* signature) {
  const double before = merit(point, penalty);
  const auto leads = [&](const EditPointPtr& trial) {
    if (!trial || (signature && trial->signature != *signature) || !(merit(*trial, penalty) < before)) return false;
    // where nothing that varies has a part in a constraint, no small change brings it back, whatever the merit says
    return !lacksImpacts(evaluator.problem(), *trial);
  };
  for (const double share : kSharesAlong) {
    const Eigen::VectorXd to = point.changes + onto + share * along;
    const EditPointPtr trial = evaluator.evaluate(to.cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper()));
    if (evaluator.halt() != Halt::none) return nullptr;
    const bool bent = trial && trial->signature == point.signature && trial->violation > kBent * point.violation &&
                      !evaluator.reached(*trial);
    if (bent) {
      EditPointPtr nearer = corrected(evaluator, point, *trial);
      if (nearer && nearer->violation < trial->violation && leads(nearer)) return nearer;
    }
    if (leads(trial)) return trial;
  }
  return nullptr;
}

/// The way along the constraints that is left, where the rows are linear.
double leftAlong(const EditEvaluator& evaluator, const EditPoint& point) {
  return (smallestChange(evaluator, point) - point.changes).norm();
}

/// The end of a step that leaves clearly less of the way; null where it does not.
EditPointPtr stepToStationary(EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& step,
                              const std::string* signature) {
  const Eigen::VectorXd to = point.changes + step;
  const EditPointPtr trial = evaluator.evaluate(to.cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper()));
  if (!trial || !evaluator.reached(*trial) || (signature && trial->signature != *signature)) return nullptr;
  if (!evaluator.differentiate(*trial)) return nullptr;
  return leftAlong(evaluator, *trial) < kNearer * leftAlong(evaluator, point) ? trial : nullptr;
}

/// Whether a smaller change is likely enough from a point to try the other ways. Within the sequence these brought one from 58 of
/// 3800 likely points, and from one of 1600 others.
bool isWorthMore(const EditEvaluator& evaluator, EditPoint& from, double below) {
  if (!evaluator.differentiate(from)) return false;
  return localSolveScore(estimateOf(evaluator, from, smallestStep(evaluator, from)), below) <= kLikelyScore;
}

bool isBetter(const EditEvaluator& evaluator, const EditPoint& a, const EditPoint& b) {
  if (evaluator.reached(a) && evaluator.reached(b)) return a.objective < b.objective;
  return a.violation < b.violation;
}

}  // namespace

Eigen::VectorXd smallestChange(const EditEvaluator& evaluator, const EditPoint& point) {
  Eigen::VectorXd origin = point.changes;
  origin.head(evaluator.problem().controls.size()).setZero();
  return origin + smallestStep(evaluator, linearAt(evaluator, point, origin));
}

double lengthOf(const EditProblem& problem, const Eigen::VectorXd& changes) {
  return changes.head(problem.controls.size()).norm();
}

LocalSolveEstimate estimateOf(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& onto) {
  return {point.violation, onto.norm(), lengthOf(evaluator.problem(), smallestChange(evaluator, point))};
}

EditPointPtr solveLocally(EditEvaluator& evaluator, const EditPointPtr& from, const LocalSolveOptions& options) {
  EditPointPtr point = from, best = from;
  const bool one_of_many = std::isfinite(options.below);
  const int leaping = one_of_many ? kLeapingSteps : options.max_steps;
  const Care care = one_of_many ? Care::coarse : Care::full;
  const int last = evaluator.iterations() + options.max_steps;
  double penalty = 0;  // never falls: one that did could let steps go round in circles
  ReducedHessian hessian;
  while (evaluator.iterations() < last) {
    if (!evaluator.differentiate(*point)) break;
    const Eigen::VectorXd smallest = smallestChange(evaluator, *point);
    if (!smallest.allFinite()) break;
    const Eigen::VectorXd onto = smallestStep(evaluator, *point);
    // a step onto the constraints makes the change smaller by no more than its own length
    if (lengthOf(evaluator.problem(), smallest) > options.below + onto.norm()) return nullptr;
    const Eigen::VectorXd plain = smallest - point->changes - onto;
    if (evaluator.reached(*point) && plain.norm() <= options.arrived * point->changes.norm()) break;
    const Eigen::VectorXd along = hessian.stepAlong(point->changes, *point->row_jacobian, plain);
    penalty = std::max(penalty, kAboveMultipliers * largestMultiplier(evaluator, *point, smallest));
    EditPointPtr next = stepAlong(evaluator, *point, onto, along, penalty, options.signature);
    if (!next && evaluator.reached(*point) && plain.norm() <= kFlat * point->changes.norm()) {
      next = stepToStationary(evaluator, *point, onto + along, options.signature);
      if (next) best = next;
    }
    if (!next && evaluator.halt() == Halt::none && !evaluator.reached(*point)) {
      const int steps = std::min(leaping, last - evaluator.iterations());
      next = projectOntoConstraints(evaluator, point, steps, options.signature, care);
    }
    if (!next || next == point) break;
    point = std::move(next);
    if (isBetter(evaluator, *point, *best)) best = point;
    if (!evaluator.step(point->objective, point->violation)) break;
  }
  return best;
}

EditPointPtr solveWithFallbacks(EditEvaluator& evaluator, const EditPointPtr& from, const LocalSolveOptions& options) {
  EditPointPtr end = solveLocally(evaluator, from, options);
  if (!std::isfinite(options.below)) return end;  // its steps across boundaries are as many as it may take
  const auto missed = [&] { return end && !evaluator.reached(*end) && evaluator.halt() == Halt::none; };
  if (!missed() || !isWorthMore(evaluator, *from, options.below)) return end;
  for (const std::string* kept : std::initializer_list<const std::string*>{&from->signature, options.signature}) {
    if (!missed()) break;
    const EditPointPtr met = projectOntoConstraints(evaluator, from, options.max_steps, kept, Care::coarse);
    if (!evaluator.reached(*met)) continue;
    LocalSolveOptions along = options;
    along.signature = kept;
    end = solveLocally(evaluator, met, along);
  }
  return end;
}

}  // namespace carom::editing_detail
