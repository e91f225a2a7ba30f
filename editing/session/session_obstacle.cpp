// SPDX-License-Identifier: MIT
// Sentences about a gesture: what changed on the way, what stands in its way.
#include <algorithm>
#include <cmath>

#include "editing/detail/messages.hpp"
#include "editing/sequence_changes.h"
#include "editing/session/session_solver.hpp"

namespace carom::editing_detail {
namespace {

constexpr std::size_t kFewChanges = 3;
/// A step that would bring the goal nearer by more than this share could have been taken.
constexpr double kCouldGoOn = 0.05;
/// A number this near to its bound, of its natural scale, is at it.
constexpr double kAtBound = 1e-9;

std::size_t eventsThatCount(const EditProblem& problem, const EditPoint& point) {
  return problem.constraints.extentIn(point.motion, point.rows.times).events;
}

std::vector<SequenceChange> changesBetween(const EditProblem& problem, const EditPoint& from, const EditPoint& to) {
  return sequenceChanges(from.motion, eventsThatCount(problem, from), to.motion, eventsThatCount(problem, to));
}

/// Where a step would have led: other bodies meet, or the same ones in another way.
std::string describeBorder(const EditProblem& problem, const EditPoint& from, const EditPoint& to) {
  const std::vector<SequenceChange> changes = changesBetween(problem, from, to);
  std::string what = "the order in which bodies meet";
  if (!changes.empty() && changes[0].kind != SequenceChange::Kind::order) {
    const SequenceChange& first = changes[0];
    const Motion& motion = first.before >= 0 ? from.motion : to.motion;
    const Event& event = motion.events[static_cast<std::size_t>(first.before >= 0 ? first.before : first.after)];
    const auto name = [&](int b) { return "'" + motion.scene->bodies[static_cast<std::size_t>(b)].name + "'"; };
    what = "how " + name(event.contacts[0].a) + " and " + name(event.contacts[0].b) + " meet";
  }
  return "A step nearer changes " + what + ", and of what was tried nothing leads there.";
}

std::vector<std::string> controlsAtBounds(const ControlSet& controls, const Eigen::VectorXd& changes) {
  const Eigen::VectorXd lower = controls.lowerChanges(), upper = controls.upperChanges();
  std::vector<std::string> names;
  for (int j = 0; j < controls.size(); ++j)
    if (changes[j] - lower[j] <= kAtBound || upper[j] - changes[j] <= kAtBound)
      names.push_back(controls.describeVariable(j));
  return names;
}

}  // namespace

std::string SessionSolver::describeSequenceChange() const {
  if (part_) return part_->describeSequenceChange();
  if (point_->signature == start_->signature) return "";
  const std::vector<SequenceChange> changes = changesBetween(problem_, *start_, *point_);
  std::string text;
  for (std::size_t i = 0; i < std::min(kFewChanges, changes.size()); ++i)
    text += (text.empty() ? "" : " ") + changes[i].sentence;
  if (changes.size() > kFewChanges)
    text += " " + std::to_string(changes.size() - kFewChanges) + " more impacts changed.";
  return text.empty() ? "The impacts on the way are others than before." : text;
}

std::string SessionSolver::describeObstacle() {
  if (part_) return part_->describeObstacle();
  if (problem_.unknowns() == 0) return "Nothing may vary: there are no controls.";
  const StepProblem problem = stepProblem(*point_);
  if (!point_->row_jacobian->allFinite()) return "The derivatives are not known there.";
  const std::vector<std::string> bounds =
      controlsAtBounds(problem_.controls, point_->changes.head(problem_.controls.size()));
  const std::string at_bounds =
      bounds.empty()
          ? ""
          : " At " + std::string(bounds.size() == 1 ? "its bound: " : "their bounds: ") + listOf(bounds) + ".";
  const Step step = hierarchicalStep(problem);
  if (!step.free_for_soft) {
    const bool nailed = problem.hard.size() > 0;
    return std::string(nailed ? "The nails leave nothing free that would move it."
                              : "Nothing that may vary moves it there.") +
           at_bounds;
  }
  const double error = problem.soft.r.norm();
  if (step.soft_after > (1 - kCouldGoOn) * error)
    return "No small change of what may vary brings it nearer." + at_bounds;
  if (beyond_ && beyond_->signature != point_->signature)
    return describeBorder(problem_, *point_, *beyond_) + at_bounds;
  return "The work of one update was done before it was there." + at_bounds;
}

}  // namespace carom::editing_detail
