// SPDX-License-Identifier: MIT
#include "editing/strategy/boundary_minimum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "editing/certificate.h"
#include "editing/problem/margins/sequence_boundaries.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/solve/projection.hpp"
#include "editing/solve/reduced_hessian.hpp"
#include "editing/strategy/approach.hpp"
#include "editing/strategy/local_solve.hpp"
#include "editing/strategy/missing_impacts.hpp"

namespace carom::editing_detail {
namespace {

/// A change that could be smaller by more than this share of it, without boundaries.
constexpr double kCouldBeSmaller = 2e-3;
/// A step counts when it makes the change smaller by this share.
constexpr double kWorthAStep = 1e-4;
/// How near steps go to a boundary, as a share of the distance to it.
constexpr double kShortOfBoundary = 0.02;
/// Steps are shortened by this, down to that share of them; the next one begins a little longer than the last.
constexpr double kShorter = 0.3, kShortest = 1e-3;
/// Steps back to an impact that a step has lost.
constexpr int kBackSteps = 3;
constexpr int kSweeps = 300;

/// Half-spaces normal . y >= offset, unit normals in columns.
struct HalfSpaces {
  Eigen::MatrixXd normals;
  Eigen::VectorXd offsets;
};

/// The point of least norm in all of them, with a multiplier of each, by Hildreth's method: the dual is ascended one
/// multiplier at a time.
std::pair<Eigen::VectorXd, Eigen::VectorXd> leastNorm(const HalfSpaces& spaces) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(spaces.normals.rows());
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(spaces.normals.cols());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double moved = 0;
    for (Eigen::Index i = 0; i < multipliers.size(); ++i) {
      const double lacks = spaces.offsets[i] - spaces.normals.col(i).dot(y);
      const double more = std::max(-multipliers[i], lacks);
      multipliers[i] += more;
      y += more * spaces.normals.col(i);
      moved = std::max(moved, std::abs(more));
    }
    if (moved <= 1e-12 * (1 + y.norm())) break;
  }
  return {y, multipliers};
}

/// The boundaries of a point's sequence along the directions N that change no row, as they are linear around the point: the
/// unknowns are z + N y, with z the smallest change that meets the linear rows.
HalfSpaces boundariesAlong(const EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& z,
                           const Eigen::MatrixXd& N) {
  const EditProblem& problem = evaluator.problem();
  const Eigen::Index n = problem.controls.size();
  DerivativeTape tape(point.motion, problem.leaver());
  HalfSpaces spaces{Eigen::MatrixXd(N.cols(), 0), {}};
  std::vector<double> offsets;
  for (const EventMargin& boundary : sequenceBoundaries(problem, point.changes, tape, point.rows, kBoundariesUpTo)) {
    const double slope = boundary.gradient.norm();
    if (boundary.value == 0 || !(slope > 0) || !std::isfinite(slope)) continue;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(point.changes.size());
    gradient.head(n) = (boundary.value < 0 ? -1 : 1) * boundary.gradient;
    const Eigen::VectorXd normal = N.transpose() * gradient;
    const double length = normal.norm();
    if (!(length > 1e-9 * slope)) continue;
    // value + gradient . (z + N y - x) >= a little of the value
    const double offset = (kShortOfBoundary - 1) * std::abs(boundary.value) - gradient.dot(z - point.changes);
    spaces.normals.conservativeResize(N.cols(), spaces.normals.cols() + 1);
    spaces.normals.rightCols<1>() = normal / length;
    offsets.push_back(offset / length);
  }
  spaces.offsets = Eigen::Map<const Eigen::VectorXd>(offsets.data(), static_cast<Eigen::Index>(offsets.size()));
  return spaces;
}

/// The step to the smallest change within the rows and boundaries as they are linear around a point.
struct BoundaryStep {
  Eigen::VectorXd up_to;              ///< to the rows, and to the boundaries that hinder
  Eigen::VectorXd along;              ///< along both
  Eigen::MatrixXd held;               ///< rows and normals of these boundaries, a line each
  std::vector<Eigen::Index> hinders;  ///< which boundaries these are, of those of the point
};

BoundaryStep stepWithinBoundaries(const EditEvaluator& evaluator, const EditPoint& point) {
  const Eigen::VectorXd smallest = smallestChange(evaluator, point);
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  const HalfSpaces spaces = boundariesAlong(evaluator, point, smallest, free);
  // |z + N y|^2 = |z|^2 + |y|^2
  const auto [y, multipliers] = leastNorm(spaces);
  BoundaryStep step;
  for (Eigen::Index i = 0; i < multipliers.size(); ++i)
    if (multipliers[i] > 0) step.hinders.push_back(i);
  step.held.resize(point.row_jacobian->rows() + static_cast<Eigen::Index>(step.hinders.size()), point.changes.size());
  step.held.topRows(point.row_jacobian->rows()) = *point.row_jacobian;
  Eigen::Index row = point.row_jacobian->rows();
  for (const Eigen::Index i : step.hinders) step.held.row(row++) = (free * spaces.normals.col(i)).transpose();
  const Eigen::VectorXd whole = smallest + free * y - point.changes;
  const Eigen::MatrixXd within = nullSpace(step.held);
  step.along = within * (within.transpose() * whole);
  step.up_to = whole - step.along;
  return step;
}

/// A smaller change at a place or near it, of the sequence of a point unless any will do; null where there is none. Boundaries
/// are curved: where an impact is missed, the least distance at which its bodies pass leads back to it.
EditPointPtr smallerNear(EditEvaluator& evaluator, const EditPoint& point, const Eigen::VectorXd& place) {
  if (!(lengthOf(evaluator.problem(), place) < lengthOf(evaluator.problem(), point.changes))) return nullptr;
  const MotionMaker lacking{{}, nullptr, true};
  EditPointPtr trial = evaluator.make(place, false, lacking);
  if (trial && lacksImpacts(evaluator.problem(), *trial)) {
    EditEvaluator back = evaluator.branch(lacking, true);
    trial = approach(back, trial, kBackSteps, Aim::just_into);
    if (lacksImpacts(evaluator.problem(), *trial)) return nullptr;
  }
  if (!trial) return nullptr;
  const bool crosses = trial->signature != point.signature;
  if (crosses && evaluator.options().sequence != SequencePolicy::smallest) return nullptr;
  if (!evaluator.reached(*trial)) trial = projectOntoConstraints(evaluator, trial, kOntoSteps, crosses ? nullptr : &point.signature);
  if (!evaluator.reached(*trial) || !(trial->objective < (1 - kWorthAStep) * point.objective)) return nullptr;
  evaluator.consider(trial);
  return trial;
}

/// Whether a point that meets the constraints could change clearly less if it were not for the boundary of its impact
/// sequence: as the rows are linear around it.
bool isAtBoundary(const EditEvaluator& evaluator, EditPoint& point) {
  const EditProblem& problem = evaluator.problem();
  if (problem.constraints.objective() || point.motion.world_lines.size() > kMarginBodies) return false;
  if (!evaluator.differentiate(point)) return false;
  const double length = lengthOf(problem, point.changes);
  return lengthOf(problem, smallestChange(evaluator, point)) < (1 - kCouldBeSmaller) * length;
}

}  // namespace

EditPointPtr minimiseAlongBoundary(EditEvaluator& evaluator, EditPointPtr point, int max_steps) {
  ReducedHessian hessian;  // of the boundaries that hinder, as long as these are the same
  std::vector<Eigen::Index> hindered;
  double longest = 1;
  for (int k = 0; k < max_steps && evaluator.halt() == Halt::none && isAtBoundary(evaluator, *point); ++k) {
    const BoundaryStep step = stepWithinBoundaries(evaluator, *point);
    if (!step.up_to.allFinite() || !step.along.allFinite()) break;
    if (step.hinders != hindered) hessian = {};
    hindered = step.hinders;
    const Eigen::VectorXd whole = step.up_to + hessian.stepAlong(point->changes, step.held, step.along);
    EditPointPtr next;
    double share = longest;
    for (; share > kShortest && evaluator.halt() == Halt::none; share *= kShorter) {
      const Eigen::VectorXd place = point->changes + share * whole;
      next = smallerNear(evaluator, *point, place.cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper()));
      if (next) break;
    }
    if (!next || !evaluator.step(next->objective, next->violation)) break;
    if (next->signature != point->signature) hessian = {};
    point = std::move(next);
    longest = std::min(1.0, share / kShorter);
  }
  return point;
}

}  // namespace carom::editing_detail
