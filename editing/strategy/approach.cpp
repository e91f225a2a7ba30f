// SPDX-License-Identifier: MIT
#include "editing/strategy/approach.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/controls/natural_scales.hpp"
#include "editing/problem/rows/closest_approach.hpp"
#include "editing/strategy/missing_impacts.hpp"

namespace carom::editing_detail {
namespace {

/// A share of what is required counts as much as so many distances.
constexpr double kShareCounts = 10;
/// How far into the other body a step aims, in lengths of the smaller one; just into it, with a share of the distance.
constexpr double kWellInto = 0.3, kJustInto = 1e-7, kBeyondDistance = 0.02;
/// Shares of a step that are tried.
constexpr double kShortenings[] = {1, 0.5, 0.2};
/// Share of a distance that a natural speed has to take off, so that it is told.
constexpr double kSomeNearer = 0.1;

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

EditPointPtr approach(EditEvaluator& evaluator, EditPointPtr point, int max_steps, Aim aim) {
  const EditProblem& problem = evaluator.problem();
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
      const Eigen::VectorXd there = (point->changes + share * step).cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper());
      const EditPointPtr trial = evaluator.evaluate(there, true);
      if (!trial) continue;
      const double left = lackOf(problem, *trial);
      if (!(left < lack)) continue;
      next = trial, lack = left;
      break;
    }
    if (!next || !evaluator.step(next->objective, next->violation)) break;
    point = std::move(next);
  }
  return point;
}

namespace {

/// The component of a start velocity that does not vary and would bring two bodies nearer most, if by more than a little.
std::string lockedHint(const EditProblem& problem, const EditPoint& point, const ClosestApproach& nearest) {
  if (!nearest.nearest.apart()) return "";
  const Scene& scene = problem.controls.startScene();
  const std::vector<StateSeed> seeds = nearest.seeds();
  const SceneGradient gradient = adjoint(point.motion, seeds);
  std::string best;
  double most = kSomeNearer * nearest.value();
  for (const int b : {nearest.a, nearest.b}) {
    const Body& body = scene.bodies[static_cast<std::size_t>(b)];
    if (body.immovable()) continue;
    const double speed = naturalScales(scene, b).velocity;
    for (int k = 0; k < 3; ++k) {
      const std::string component(1, "xyz"[k]);
      const auto varies = [&](const Variable& v) {
        const Control& control = problem.controls.controls()[static_cast<std::size_t>(v.control)].control;
        return control.body == body.name && control.vary == "velocity" && v.component == component;
      };
      const std::vector<Variable>& variables = problem.controls.variables();
      const double nearer = std::abs(gradient.bodies[static_cast<std::size_t>(b)].velocity[k]) * speed;
      if (!(nearer > most) || std::any_of(variables.begin(), variables.end(), varies)) continue;
      most = nearer;
      best = " Velocity." + component + " of '" + body.name + "', which does not vary, would bring them nearer.";
    }
  }
  return best;
}

}  // namespace

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
         brief(nearest->value()) + " m, at " + brief(nearest->time) + " s." + lockedHint(problem, point, *nearest);
}

}  // namespace carom::editing_detail
