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

/// Borders cost a reverse pass each, and an impact has several of them.
constexpr std::size_t kMostEvents = 16;
/// How far beyond a border, in lengths of the change, and the least of it in natural scales.
constexpr double kBeyond = 0.05, kLeastBeyond = 1e-4;
/// A direction that crosses a border by less than this share of its gradient does not cross it.
constexpr double kAlong = 1e-3;

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
  for (const EventMargin& border : sequenceBorders(problem, point.changes, tape, point.rows, kMostEvents)) {
    const double slope = border.gradient.norm();
    if (!(slope > 0) || !std::isfinite(slope) || !std::isfinite(border.value)) continue;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(point.changes.size());
    gradient.head(n) = border.gradient / slope;
    const Eigen::VectorXd across = free * (free.transpose() * gradient);
    const double rate = across.squaredNorm();  // of the border's distance along `across`
    if (!(rate > kAlong * kAlong)) continue;
    // where the smallest change is, seen from the border: on this side of it, or beyond
    const double side = border.value < 0 ? -1 : 1;
    const double before = side * (border.value / slope + gradient.dot(smallest - point.changes));
    const double way = std::max(0.0, before + beyond) / rate;
    const Eigen::VectorXd place =
        (smallest - side * way * across).cwiseMax(search.lower()).cwiseMin(search.upper());
    const double length = lengthOf(problem, place);
    if (length < below) places.emplace_back(length, place);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> list;
  for (auto& [length, place] : places)
    if (list.empty() || place != list.back()) list.push_back(std::move(place));
  return list;
}

}  // namespace carom::editing_detail
