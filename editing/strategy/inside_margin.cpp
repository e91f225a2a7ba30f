// SPDX-License-Identifier: MIT
#include "editing/strategy/inside_margin.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "editing/certificate.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/margins/sequence_boundaries.hpp"
#include "editing/solve/dependence.hpp"
#include "editing/solve/projection.hpp"
#include "editing/strategy/missing_impacts.hpp"

namespace carom::editing_detail {
namespace {

/// Shares of EditOptions::graze_margin that are tried, and what they may cost of the objective.
constexpr double kInsideShares[] = {1, 0.3, 0.1, 0.03};
constexpr double kInsideCost = 0.01;
/// So far beyond the boundary, as a share of the margin, it is looked whether the impact is lost.
constexpr double kJustBeyond = 0.1;
/// A point counts as inside where it is at this share of the margin by its own derivatives: boundaries are curved.
constexpr double kAboutInside = 0.5;
/// Steps away from one boundary after the other.
constexpr int kInsideSteps = 4;

/// The nearest boundary within `margin` beyond which an impact that is needed is lost.
std::optional<EventMargin> nearestLoss(const EditEvaluator& evaluator, const EditPoint& point, double margin) {
  const EditProblem& problem = evaluator.problem();
  DerivativeTape tape(point.motion, problem.leaver());
  std::optional<EventMargin> nearest;
  for (EventMargin& boundary : sequenceBoundaries(problem, point.changes, tape, point.rows, kBoundariesUpTo)) {
    const double distance = boundary.distance();
    if (!(distance < margin) || boundary.value == 0 || (nearest && nearest->distance() <= distance)) continue;
    Eigen::VectorXd beyond = point.changes;
    const double slope = boundary.gradient.norm();
    beyond.head(problem.controls.size()) -= (boundary.value > 0 ? 1 : -1) * (distance + kJustBeyond * evaluator.options().graze_margin) / slope * boundary.gradient;
    const EditPointPtr trial = evaluator.make(beyond, false, {{}, nullptr, true});
    if (trial && lacksImpacts(problem, *trial)) nearest = std::move(boundary);
  }
  return nearest;
}

/// One step away from a boundary up to the margin, along the constraints and back onto them; null where there is none.
EditPointPtr stepInside(EditEvaluator& evaluator, EditPoint& point, const EventMargin& boundary, double margin) {
  if (!evaluator.differentiate(point)) return nullptr;
  const Eigen::MatrixXd free = nullSpace(*point.row_jacobian);
  Eigen::VectorXd away = Eigen::VectorXd::Zero(point.changes.size());
  away.head(evaluator.problem().controls.size()) = (boundary.value > 0 ? 1 : -1) * boundary.gradient.normalized();
  const Eigen::VectorXd within = free * (free.transpose() * away);
  const double square = within.squaredNorm();
  if (!(square > 1e-6)) return nullptr;  // the constraints leave no way
  const Eigen::VectorXd to = point.changes + (margin - boundary.distance()) / square * within;
  EditPointPtr trial = evaluator.evaluate(to.cwiseMax(evaluator.lower()).cwiseMin(evaluator.upper()));
  if (trial && !evaluator.reached(*trial)) trial = projectOntoConstraints(evaluator, trial, kOntoSteps, &trial->signature);
  return trial && evaluator.reached(*trial) ? trial : nullptr;
}

EditPointPtr insideBy(EditEvaluator& evaluator, const EditPointPtr& from, double margin) {
  const bool any = evaluator.options().sequence == SequencePolicy::smallest;
  EditPointPtr point = from;
  for (int k = 0; k < kInsideSteps && point; ++k) {
    const std::optional<EventMargin> loss = nearestLoss(evaluator, *point, kAboutInside * margin);
    if (!loss) return any || point->signature == from->signature ? point : nullptr;
    point = stepInside(evaluator, *point, *loss, margin);
  }
  return nullptr;
}

}  // namespace

MovedInside movedInside(EditEvaluator& evaluator, const EditPointPtr& point) {
  const EditProblem& problem = evaluator.problem();
  if (!problem.constraints.waits() || problem.constraints.objective() || problem.controls.size() == 0 || evaluator.options().graze_margin == 0) return {};
  if (point->motion.world_lines.size() > kMarginBodies || evaluator.halt() != Halt::none) return {};
  const std::optional<EventMargin> loss = nearestLoss(evaluator, *point, kAboutInside * evaluator.options().graze_margin);
  if (!loss) return {};
  const std::string lost = "would be lost at a change of " + brief(loss->distance()) + " natural scales";
  for (const double share : kInsideShares) {
    const double margin = share * evaluator.options().graze_margin;
    if (!(loss->distance() < kAboutInside * margin)) break;
    const EditPointPtr inside = insideBy(evaluator, point, margin);
    if (!inside || !(inside->objective <= (1 + kInsideCost) * point->objective)) continue;
    return {inside, "An impact that is needed " + lost + " from the smallest change that was found: the answer lies " + brief(margin) + " inside."};
  }
  return {nullptr, "An impact that is needed " + lost + ": to go inside by more would make the change larger by more than 1 %."};
}

}  // namespace carom::editing_detail
