// SPDX-License-Identifier: MIT
#include "editing/strategy/border_minimum.hpp"

#include <algorithm>
#include <cmath>

#include "editing/certificate.h"
#include "editing/problem/margins/sequence_borders.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/landing.hpp"

namespace carom::editing_detail {
namespace {

/// A change that could be smaller by more than this share of it, without borders.
constexpr double kCouldBeSmaller = 2e-3;
/// A step counts when it makes the change smaller by this share.
constexpr double kWorthAStep = 1e-4;
/// How near steps go to a border, as a share of the distance to it.
constexpr double kShortOfBorder = 0.02;
constexpr double kBorderShares[] = {1, 0.5, 0.25, 0.1, 0.03};
constexpr int kSweeps = 300;

/// Half-spaces normal . y >= offset, unit normals in columns.
struct HalfSpaces {
  Eigen::MatrixXd normals;
  Eigen::VectorXd offsets;
};

/// The point of least norm in all of them, by Hildreth's method: the dual is ascended one multiplier at a time.
Eigen::VectorXd leastNorm(const HalfSpaces& spaces) {
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
  return y;
}

/// With z the smallest change that meets the linear rows and N the directions that change none, the unknowns are
/// z + N y, and |z + N y|^2 = |z|^2 + |y|^2.
Eigen::VectorXd smallestWithinBorders(const EditSearch& search, const EditPoint& point) {
  const EditProblem& problem = search.problem();
  const Eigen::VectorXd smallest = smallestChange(search, point);
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  const Eigen::Index n = problem.controls.size();
  DerivativeTape tape(point.motion);
  HalfSpaces spaces{Eigen::MatrixXd(free.cols(), 0), {}};
  std::vector<double> offsets;
  for (const EventMargin& border : sequenceBorders(problem, point.changes, tape, point.rows, kBordersUpTo)) {
    const double slope = border.gradient.norm();
    if (border.value == 0 || !(slope > 0) || !std::isfinite(slope)) continue;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(point.changes.size());
    gradient.head(n) = (border.value < 0 ? -1 : 1) * border.gradient;
    const Eigen::VectorXd normal = free.transpose() * gradient;
    const double length = normal.norm();
    if (!(length > 1e-9 * slope)) continue;
    // value + gradient . (z + N y - x) >= a little of the value
    const double value = std::abs(border.value);
    const double offset = (kShortOfBorder - 1) * value - gradient.dot(smallest - point.changes);
    spaces.normals.conservativeResize(free.cols(), spaces.normals.cols() + 1);
    spaces.normals.rightCols<1>() = normal / length;
    offsets.push_back(offset / length);
  }
  spaces.offsets = Eigen::Map<const Eigen::VectorXd>(offsets.data(), static_cast<Eigen::Index>(offsets.size()));
  return smallest + free * leastNorm(spaces);
}

}  // namespace

bool isAtBorder(const EditSearch& search, EditPoint& point) {
  const EditProblem& problem = search.problem();
  if (problem.constraints.objective() || point.motion.world_lines.size() > kMarginBodies) return false;
  if (!search.differentiate(point)) return false;
  const double length = lengthOf(problem, point.changes);
  return lengthOf(problem, smallestChange(search, point)) < (1 - kCouldBeSmaller) * length;
}

EditPointPtr minimiseAlongBorder(EditSearch& search, EditPointPtr point, int max_steps) {
  for (int k = 0; k < max_steps && search.halt() == Halt::none && isAtBorder(search, *point); ++k) {
    const Eigen::VectorXd target = smallestWithinBorders(search, *point);
    if (!target.allFinite()) break;
    EditPointPtr next;
    for (const double share : kBorderShares) {
      const Eigen::VectorXd place = point->changes + share * (target - point->changes);
      EditPointPtr trial = search.evaluate(place.cwiseMax(search.lower()).cwiseMin(search.upper()));
      if (!trial || trial->signature != point->signature) continue;
      if (!search.reached(*trial)) trial = projectOntoConstraints(search, trial, kOntoSteps, &point->signature);
      if (!search.reached(*trial) || !(trial->objective < (1 - kWorthAStep) * point->objective)) continue;
      next = trial;
      break;
    }
    if (!next || !search.step(next->objective, next->violation)) break;
    point = std::move(next);
  }
  return point;
}

}  // namespace carom::editing_detail
