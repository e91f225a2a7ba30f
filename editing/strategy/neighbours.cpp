// SPDX-License-Identifier: MIT
#include "editing/strategy/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "editing/certificate.h"
#include "editing/problem/margins/near_misses.hpp"
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
/// How far bodies that nearly meet are to come into each other, in lengths of the smaller one.
constexpr double kInto = 0.1;

/// A border of an impact sequence, as it is linear around a point x: at x - distance normal.
struct Border {
  double distance;
  Eigen::VectorXd normal;  ///< of unit length, away from it
  double beyond;           ///< how far beyond it to go
};

/// Those at which an impact of the motion becomes another one, and those at which bodies meet that nearly do.
std::vector<Border> bordersAround(const EditSearch& search, const EditPoint& point, double beyond,
                                  std::size_t near_misses) {
  const EditProblem& problem = search.problem();
  std::vector<Border> borders;
  const auto add = [&](double value, const Eigen::VectorXd& gradient, double further) {
    const double slope = gradient.norm();
    if (!(slope > 0) || !std::isfinite(slope) || !std::isfinite(value)) return;
    Eigen::VectorXd normal = Eigen::VectorXd::Zero(point.changes.size());
    normal.head(gradient.size()) = (value < 0 ? -1 : 1) / slope * gradient;
    borders.push_back({std::abs(value) / slope, std::move(normal), further / slope});
  };
  DerivativeTape tape(point.motion);
  for (const EventMargin& margin : sequenceBorders(problem, point.changes, tape, point.rows, kBordersUpTo))
    add(margin.value, margin.gradient, beyond * margin.gradient.norm());
  for (const NearMiss& miss : nearMisses(problem, point.changes, tape, point.rows, near_misses))
    add(miss.gap, miss.gradient, kInto * miss.length);
  search.countPasses(borders.size());
  return borders;
}


}  // namespace

std::vector<Eigen::VectorXd> beyondBorders(const EditSearch& search, const EditPoint& point, double below,
                                           std::size_t near_misses) {
  const EditProblem& problem = search.problem();
  if (point.motion.world_lines.size() > kMarginBodies) return {};
  const Eigen::VectorXd smallest = smallestChange(search, point);
  if (!smallest.allFinite()) return {};
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  std::vector<std::pair<double, Eigen::VectorXd>> places;
  const auto add = [&](const Eigen::VectorXd& to) {
    Eigen::VectorXd place = to.cwiseMax(search.lower()).cwiseMin(search.upper());
    const double length = lengthOf(problem, place);
    if (length < below) places.emplace_back(length, std::move(place));
  };
  const double beyond = std::max(kLeastBeyond, kBeyond * lengthOf(problem, smallest));
  for (const Border& border : bordersAround(search, point, beyond, near_misses)) {
    const double further = border.distance + border.beyond;
    if (border.distance < kFarthest) add(point.changes - further * border.normal);
    const Eigen::VectorXd across = free * (free.transpose() * border.normal);
    const double rate = across.squaredNorm();  // of the distance from the border along `across`
    const double before = further + border.normal.dot(smallest - point.changes);  // of the smallest change
    if (rate > kAlong * kAlong) add(smallest - std::max(0.0, before) / rate * across);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> list;
  for (auto& [length, place] : places)
    if (list.empty() || place != list.back()) list.push_back(std::move(place));
  return list;
}

}  // namespace carom::editing_detail
