// SPDX-License-Identifier: MIT
#include "editing/strategy/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editing/certificate.h"
#include "editing/problem/margins/sequence_borders.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/strategy/landing.hpp"

namespace carom::editing_detail {
namespace {

/// How far beyond a border, in lengths of the change, and the least of it in natural scales.
constexpr double kBeyond = 0.05, kLeastBeyond = 1e-4;
/// A direction that crosses a border by less than this share of its gradient does not cross it.
constexpr double kAlong = 1e-3;
/// Borders that are farther away, in natural scales, are not looked at.
constexpr double kFarthest = 3;

}  // namespace

std::vector<Eigen::VectorXd> beyondBorders(const EditSearch& search, const EditPoint& point, double below) {
  const EditProblem& problem = search.problem();
  if (point.motion.world_lines.size() > kMarginBodies) return {};
  const Eigen::VectorXd smallest = smallestChange(search, point);
  if (!smallest.allFinite()) return {};
  const Eigen::Index n = problem.controls.size();
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  const double beyond = std::max(kLeastBeyond, kBeyond * lengthOf(problem, smallest));
  DerivativeTape tape(point.motion);
  std::vector<std::pair<double, Eigen::VectorXd>> places;
  const auto add = [&](const Eigen::VectorXd& to) {
    Eigen::VectorXd place = to.cwiseMax(search.lower()).cwiseMin(search.upper());
    const double length = lengthOf(problem, place);
    if (length < below) places.emplace_back(length, std::move(place));
  };
  for (const EventMargin& border : sequenceBorders(problem, point.changes, tape, point.rows, kBordersUpTo)) {
    const double slope = border.gradient.norm();
    if (!(slope > 0) || !std::isfinite(slope) || !std::isfinite(border.value)) continue;
    Eigen::VectorXd normal = Eigen::VectorXd::Zero(point.changes.size());
    normal.head(n) = (border.value < 0 ? -1 : 1) / slope * border.gradient;
    const double distance = std::abs(border.value) / slope;
    if (distance < kFarthest) add(point.changes - (distance + beyond) * normal);
    const Eigen::VectorXd across = free * (free.transpose() * normal);
    const double rate = across.squaredNorm();  // of the distance from the border along `across`
    const double before = distance + normal.dot(smallest - point.changes);  // of the smallest change
    if (rate > kAlong * kAlong) add(smallest - std::max(0.0, before + beyond) / rate * across);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> list;
  for (auto& [length, place] : places)
    if (list.empty() || place != list.back()) list.push_back(std::move(place));
  return list;
}

}  // namespace carom::editing_detail
