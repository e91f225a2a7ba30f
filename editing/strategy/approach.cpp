// SPDX-License-Identifier: MIT
#include "editing/strategy/approach.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/closest_approach.hpp"
#include "editing/strategy/missing_impacts.hpp"

namespace carom::editing_detail {
namespace {

/// A share of the wish counts as much as so many distances.
constexpr double kShareCounts = 10;
/// How far into the other body a step aims, in lengths of the smaller one; just into it, with a share of the distance.
constexpr double kWellInto = 0.3, kJustInto = 1e-7, kBeyondDistance = 0.02;
/// Shares of a step that are tried.
constexpr double kShortenings[] = {1, 0.5, 0.2};

/// Null where it is not known: the motion ends at once, or nothing tells distances.
std::optional<ClosestApproach> nearestOf(const EditPoint& point, const LackingImpact& lacking) {
  std::optional<ClosestApproach> nearest;
  for (const auto& [a, b] : lacking.pairs) {
    try {
      std::optional<ClosestApproach> one = closestApproach(point.motion, a, b, lacking.from, lacking.to);
      if (one && (!nearest || one->value() < nearest->value())) nearest = std::move(one);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }
  return nearest;
}

double lackOf(const EditProblem& problem, const LackingImpact& lacking, const std::optional<ClosestApproach>& nearest) {
  const double share = kShareCounts * (1 - lacking.share);
  if (!nearest) return share + 1;
  const double d = nearest->value();
  return share + d / (d + lengthOfSmaller(problem.controls.startScene(), nearest->a, nearest->b));
}

}  // namespace

double lackOf(const EditProblem& problem, const EditPoint& point) {
  double lack = 0;
  for (const LackingImpact& lacking : missingImpacts(problem, point))
    lack += lackOf(problem, lacking, nearestOf(point, lacking));
  return lack;
}

EditPointPtr approach(EditSearch& search, EditPointPtr point, int max_steps, Aim aim) {
  const EditProblem& problem = search.problem();
  const Eigen::Index n = problem.controls.size();
  double lack = lackOf(problem, *point);
  for (int k = 0; k < max_steps; ++k) {
    const std::vector<LackingImpact> missing = missingImpacts(problem, *point);
    if (missing.empty()) break;
    const std::optional<ClosestApproach> nearest = nearestOf(*point, missing.front());
    if (!nearest || !(nearest->value() > 0)) break;
    const std::vector<StateSeed> seeds = nearest->seeds();
    const Eigen::VectorXd row = problem.byChanges(adjoint(point->motion, seeds), point->changes);
    if (!(row.squaredNorm() > 0) || !row.allFinite()) break;
    const double length = lengthOfSmaller(problem.controls.startScene(), nearest->a, nearest->b);
    const double way = aim == Aim::well_into ? nearest->value() + kWellInto * length
                                             : (1 + kBeyondDistance) * nearest->value() + kJustInto * length;
    Eigen::VectorXd step = Eigen::VectorXd::Zero(problem.unknowns());
    step.head(n) = -way / row.squaredNorm() * row;
    EditPointPtr next;
    for (const double share : kShortenings) {
      const Eigen::VectorXd there = (point->changes + share * step).cwiseMax(search.lower()).cwiseMin(search.upper());
      const EditPointPtr trial = search.evaluate(there, true);
      if (!trial) continue;
      const double left = lackOf(problem, *trial);
      if (!(left < lack)) continue;
      next = trial, lack = left;
      break;
    }
    if (!next || !search.step(next->objective, next->violation)) break;
    point = std::move(next);
  }
  return point;
}

std::string describeApproach(const EditProblem& problem, const EditPoint& point) {
  if (point.rows.lacking.empty()) return "";
  const LackingImpact& lacking = point.rows.lacking.front();
  const Constraint& held = problem.constraints.constraints()[static_cast<std::size_t>(lacking.constraint)];
  if (held.at.rest) {
    if (!(point.motion.end > 0)) return "";
    const BodyState last = point.motion.stateAt(held.body, point.motion.end);
    return "The slowest ends with " + brief(last.velocity.norm()) + " m/s and " + brief(last.angular_velocity.norm()) +
           " rad/s.";
  }
  const std::optional<ClosestApproach> nearest = nearestOf(point, lacking);
  if (!nearest) return "";
  const std::vector<Body>& bodies = problem.controls.startScene().bodies;
  const auto name = [&](int body) { return "'" + bodies[static_cast<std::size_t>(body)].name + "'"; };
  return "The nearest that " + name(nearest->a) + " and " + name(nearest->b) + " came was " +
         brief(nearest->value()) + " m, at " + brief(nearest->time) + " s.";
}

}  // namespace carom::editing_detail
