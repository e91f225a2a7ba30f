// SPDX-License-Identifier: MIT
#include "editing/strategy/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editing/certificate.h"
#include "editing/problem/margins/near_misses.hpp"
#include "editing/problem/margins/sequence_boundaries.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/strategy/local_solve.hpp"

namespace carom::editing_detail {
namespace {

/// How far beyond a boundary, in lengths of the change, and the least of it in natural scales.
constexpr double kBeyond = 0.05, kLeastBeyond = 1e-4;
/// A direction that crosses a boundary by less than this share of its gradient does not cross it.
constexpr double kAlong = 1e-3;
/// Boundaries that are farther away, in natural scales, are not looked at.
constexpr double kFarthest = 3;
/// How far bodies that nearly meet are to come into each other, in lengths of the smaller one.
constexpr double kInto = 0.1;

/// A boundary of an impact sequence, as it is linear around a point x: at x - distance normal.
struct Boundary {
  double distance;
  Eigen::VectorXd normal;  ///< of unit length, away from it
  double beyond;           ///< how far beyond it to go
};

/// Those at which an impact of the motion becomes another one, and those at which bodies meet that nearly do.
std::vector<Boundary> boundariesAround(const EditEvaluator& evaluator, const EditPoint& point, double beyond,
                                       std::size_t near_misses) {
  const EditProblem& problem = evaluator.problem();
  std::vector<Boundary> boundaries;
  const auto add = [&](double value, const Eigen::VectorXd& gradient, double further) {
    const double slope = gradient.norm();
    if (!(slope > 0) || !std::isfinite(slope) || !std::isfinite(value)) return;
    Eigen::VectorXd normal = Eigen::VectorXd::Zero(point.changes.size());
    normal.head(gradient.size()) = (value < 0 ? -1 : 1) / slope * gradient;
    boundaries.push_back({std::abs(value) / slope, std::move(normal), further / slope});
  };
  DerivativeTape tape(point.motion, problem.leaver());
  for (const EventMargin& margin : sequenceBoundaries(problem, point.changes, tape, point.rows, kBoundariesUpTo))
    add(margin.value, margin.gradient, beyond * margin.gradient.norm());
  for (const NearMiss& miss : nearMisses(problem, point.changes, tape, point.rows, near_misses))
    add(miss.gap, miss.gradient, kInto * miss.length);
  evaluator.countPasses(boundaries.size());
  return boundaries;
}


}  // namespace

std::vector<Eigen::VectorXd> beyondBoundaries(const EditEvaluator& evaluator, const EditPoint& point, double below,
                                              std::size_t near_misses) {
  const EditProblem& problem = evaluator.problem();
  if (point.motion.world_lines.size() > kMarginBodies) return {};
  const Eigen::VectorXd smallest = smallestChange(evaluator, point);
  if (!smallest.allFinite()) return {};
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  std::vector<std::pair<double, Eigen::VectorXd>> places;
  const auto add = [&](const Eigen::VectorXd& to) {
    Eigen::VectorXd place = to.cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper());
    const double length = lengthOf(problem, place);
    if (length < below) places.emplace_back(length, std::move(place));
  };
  const double beyond = std::max(kLeastBeyond, kBeyond * lengthOf(problem, smallest));
  for (const Boundary& boundary : boundariesAround(evaluator, point, beyond, near_misses)) {
    const double further = boundary.distance + boundary.beyond;
    if (boundary.distance < kFarthest) add(point.changes - further * boundary.normal);
    const Eigen::VectorXd across = free * (free.transpose() * boundary.normal);
    const double rate = across.squaredNorm();  // of the distance from the boundary along `across`
    const double before = further + boundary.normal.dot(smallest - point.changes);  // of the smallest change
    if (rate > kAlong * kAlong) add(smallest - std::max(0.0, before) / rate * across);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> list;
  for (auto& [length, place] : places)
    if (list.empty() || place != list.back()) list.push_back(std::move(place));
  return list;
}

}  // namespace carom::editing_detail
