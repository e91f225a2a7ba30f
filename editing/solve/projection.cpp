// SPDX-License-Identifier: MIT
#include "editing/solve/projection.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/numeric/decompositions.hpp"
#include "editing/solve/step_bounds.hpp"

namespace carom::editing_detail {
namespace {

/// Validity rows nearer than this to their limit are held at it.
constexpr double kActiveValidity = 1e-6;
/// Steps across the boundary of an impact sequence that may make things worse at first.
constexpr int kProjectionLeaps = 8;
/// Where rounding leaves nothing to improve.
constexpr double kExact = 1e-14;
/// A step that leaves a range by more than this, dimensionless, is taken again with the range held.
constexpr double kLeavesRange = 1e-12;

/// Damping of steps, against rows of unit length: it grows until a step succeeds, and falls from one to the next.
constexpr double kLeastDamping = 1e-5, kMostDamping = 20, kLessDamping = 100;

/// Lengths and dampings that are tried.
struct Trials {
  double shortest, shorter;  ///< shares of the step, and from one to the next
  double more_damping;
};
constexpr Trials kFull{0.01, 0.5, 10}, kCoarse{0.05, 0.25, 50};

struct System {
  Eigen::MatrixXd J;
  Eigen::VectorXd r;

  void add(const Eigen::MatrixXd& from, Eigen::Index row, double residual) {
    J.conservativeResize(J.rows() + 1, from.cols());
    r.conservativeResize(J.rows());
    // Rows of one length: the rank is judged by their directions.
    const double norm = from.row(row).norm(), length = norm > 0 ? norm : 1;
    J.bottomRows<1>() = from.row(row) / length;
    r[r.size() - 1] = residual / length;
  }
};

/// The rows to bring to zero: what is held at a number, ranges that `active` names, and what would be invalid or is
/// about to be.
System systemAt(const EditProblem& problem, const EditPoint& point, const std::vector<int>& active) {
  System system;
  for (int i : problem.constraints.equations()) system.add(*point.row_jacobian, i, point.rows.scaled[i]);
  for (int i : active) {
    const Row& row = problem.constraints.rows()[i];
    const double value = point.rows.values[i];
    const double limit = std::abs(value - row.lower) < std::abs(value - row.upper) ? row.lower : row.upper;
    system.add(*point.row_jacobian, i, (value - limit) / row.scale);
  }
  for (int i = 0; i < point.validity.size(); ++i)
    if (point.validity[i] < 0) system.add(*point.validity_jacobian, i, point.validity[i] - kActiveValidity);
  if (system.r.size() == 0) system.J.resize(0, point.changes.size());
  return system;
}

/// Smallest x with A x = b (least squares where that is impossible); with damping the smallest |A x - b|^2 + damping
/// |x|^2, which does not follow directions that hardly move the rows.
Eigen::VectorXd smallestSolution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double damping) {
  if (damping > 0) {
    Eigen::MatrixXd normal = A * A.transpose();
    normal.diagonal().array() += damping;
    return A.transpose() * adjoint_detail::solveSymmetric(normal, b);
  }
  return adjoint_detail::CompleteOrthogonal(A, 1e-10).solve(b);
}

/// Smallest step with J step = -r that stays within the bounds: numbers that would leave them stop there, and the
/// others make up for it.
Eigen::VectorXd boundedStep(const System& system, double damping, const StepBounds& bounds) {
  const Eigen::Index n = bounds.at.size();
  Eigen::VectorXd step = Eigen::VectorXd::Zero(n), r = system.r;
  Indices free = allIndices(n);
  while (!free.empty()) {
    Eigen::VectorXd wanted = step;
    wanted(free) = -smallestSolution(system.J(Eigen::all, free), r, damping);
    const Indices stopped = bounds.stop(wanted, free, step);
    for (const Eigen::Index j : free) step[j] = bounds.allowed(j, wanted);
    if (stopped.empty()) break;
    for (const Eigen::Index j : stopped) r += system.J.col(j) * step[j];
  }
  return step;
}

}  // namespace

Eigen::VectorXd residualsAfter(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& step) {
  const ConstraintSet& constraints = evaluator.problem().constraints;
  Eigen::VectorXd residuals = *point.row_jacobian * step;
  for (int i = 0; i < constraints.size(); ++i) {
    const double scale = constraints.rows()[i].scale;
    residuals[i] = constraints.residual(i, point.rows.values[i] + residuals[i] * scale) / scale;
  }
  return residuals;
}

// Ranges that the step would leave are held at their limits in another try, until none is left out.
Eigen::VectorXd smallestStep(const EditEvaluator& evaluator, const EditPoint& point, double damping) {
  const EditProblem& problem = evaluator.problem();
  std::vector<int> active;
  for (int i : problem.constraints.ranges())
    if (point.rows.residuals[i] != 0) active.push_back(i);
  // A free time costs nothing, so that it goes most of the way.
  const Eigen::Index n = problem.controls.size(), times = problem.times();
  const auto stretched = [&](Eigen::VectorXd v, double factor) {
    v.tail(times) *= factor;
    return v;
  };
  const Eigen::VectorXd at = stretched(point.changes, 1 / kTimeIsCheap);
  const Eigen::VectorXd lower = stretched(evaluator.lower(), 1 / kTimeIsCheap);
  const Eigen::VectorXd upper = stretched(evaluator.upper(), 1 / kTimeIsCheap);
  for (;;) {
    System system = systemAt(problem, point, active);
    system.J.rightCols(times) *= kTimeIsCheap;
    const Eigen::VectorXd step = stretched(boundedStep(system, damping, {at, lower, upper}), kTimeIsCheap);
    if (problem.constraints.ranges().empty()) return step;
    const Eigen::VectorXd after = residualsAfter(evaluator, point, step);
    const std::size_t before = active.size();
    for (int i : problem.constraints.ranges())
      if (std::abs(after[i]) > kLeavesRange && std::find(active.begin(), active.end(), i) == active.end())
        active.push_back(i);
    if (active.size() == before || active.size() > static_cast<std::size_t>(n + times)) return step;
  }
}

namespace {

/// The steps from one point.
struct Descent {
  EditEvaluator& evaluator;
  const EditPoint& from;
  const std::string* signature;
  const Trials& trials;

  EditPointPtr tryStep(const Eigen::VectorXd& step) const {
    EditPointPtr trial = evaluator.evaluate(from.changes + step);
    return trial && (!signature || trial->signature == *signature) ? trial : nullptr;
  }

  /// The first point along a step with a smaller violation; null where there is none. `full` is the one at its end.
  EditPointPtr along(const Eigen::VectorXd& step, EditPointPtr& full) const {
    for (double length = 1; length > trials.shortest && evaluator.halt() == Halt::none; length *= trials.shorter) {
      EditPointPtr trial = tryStep(length * step);
      if (!trial) continue;
      if (length == 1) full = trial;
      if (trial->violation < from.violation) return trial;
    }
    return nullptr;
  }

  /// A damped step with a smaller violation, the least damping first; null where there is none.
  EditPointPtr damped(double& damping) const {
    for (damping = std::max(damping / kLessDamping, kLeastDamping);
         damping <= kMostDamping && evaluator.halt() == Halt::none; damping *= trials.more_damping) {
      EditPointPtr trial = tryStep(smallestStep(evaluator, from, damping));
      if (trial && trial->violation < from.violation) return trial;
    }
    damping = 0;
    return nullptr;
  }
};

}  // namespace

EditPointPtr projectOntoConstraints(EditEvaluator& evaluator, EditPointPtr from, int max_steps,
                                    const std::string* signature, Care care) {
  EditPointPtr point = std::move(from), nearest = point;
  int leaps = 0;
  double damping = 0;
  for (int k = 0; k < max_steps && point->violation > kExact; ++k) {
    if (!evaluator.differentiate(*point)) break;
    const Descent descent{evaluator, *point, signature, care == Care::full ? kFull : kCoarse};
    EditPointPtr full, next;
    if (damping <= kLeastDamping) next = descent.along(smallestStep(evaluator, *point), full);
    // At the boundary of two impact sequences the violation may have a kink that no descent leaves.
    const bool may_leap = !signature && full && leaps < kProjectionLeaps && full->signature != point->signature;
    if (!next && may_leap) next = full, ++leaps;
    // Where even a short way along the undamped step is too far, the rows are nearly dependent.
    const bool nearly_met = point->violation <= evaluator.options().tolerance;
    if (!next && !nearly_met) next = descent.damped(damping);
    if (!next) break;
    point = std::move(next);
    if (point->violation < nearest->violation) nearest = point;
    if (!evaluator.step(point->objective, point->violation)) break;
  }
  return nearest;
}

}  // namespace carom::editing_detail
