// SPDX-License-Identifier: MIT
// The obstacle of a gesture, by first derivatives: a step is tried without one thing after the other.
#include <algorithm>
#include <cmath>
#include <limits>

#include "editing/detail/messages.hpp"
#include "editing/sequence_changes.h"
#include "editing/session/session_solver.hpp"
#include "editing/session/session_words.hpp"

namespace carom::editing_detail {
namespace {

using Obstacle = SessionObstacle::Kind;

/// A step that would bring the goal nearer by more than this share could have been taken; nails alone have to be met
/// together, so that of them no more than this share may be left.
constexpr double kCouldGoOn = 0.05;
/// A number this near to its bound, of its natural scale, is at it.
constexpr double kAtBound = 1e-9;
/// Steps may be this long here: what counts is whether there is a direction.
constexpr double kAnyLength = 1e6;

std::size_t eventsThatCount(const EditProblem& problem, const EditPoint& point) {
  return problem.constraints.extentIn(point.motion, point.rows.times).events;
}

/// Where a step would have led: other bodies meet, or the same ones in another way.
std::string describeBoundary(const EditProblem& problem, const EditPoint& from, const EditPoint& to) {
  const std::vector<SequenceChange> changes =
      sequenceChanges(from.motion, eventsThatCount(problem, from), to.motion, eventsThatCount(problem, to));
  std::string what = "the order of the impacts";
  if (!changes.empty() && changes[0].kind != SequenceChange::Kind::order) {
    const SequenceChange& first = changes[0];
    if (first.before < 0 && first.after < 0) {
      what = "persistent contact";
    } else {
      const Motion& motion = first.before >= 0 ? from.motion : to.motion;
      const Event& event = motion.events[static_cast<std::size_t>(first.before >= 0 ? first.before : first.after)];
      const auto name = [&](int b) { return "'" + motion.scene->bodies[static_cast<std::size_t>(b)].name + "'"; };
      what = "how " + name(event.contacts[0].a) + " and " + name(event.contacts[0].b) + " meet";
    }
  }
  return "A step nearer changes " + what + ", and no trial got there.";
}

std::vector<std::string> controlsAtBounds(const ControlSet& controls, const Eigen::VectorXd& changes) {
  const Eigen::VectorXd lower = controls.lowerChanges(), upper = controls.upperChanges();
  std::vector<std::string> names;
  for (int j = 0; j < controls.size(); ++j)
    if (changes[j] - lower[j] <= kAtBound || upper[j] - changes[j] <= kAtBound)
      names.push_back(controls.describeVariable(j));
  return names;
}

/// Whether a step leaves no more than a share of the soft rows, to first order.
bool leaves(double share, const StepProblem& problem) {
  const Step step = hierarchicalStep(problem);
  return step.free_for_soft && step.soft_after <= share * problem.soft.r.norm();
}

StepProblem withoutBounds(StepProblem problem) {
  problem.lower.setConstant(-std::numeric_limits<double>::infinity());
  problem.upper.setConstant(std::numeric_limits<double>::infinity());
  return problem;
}

StepProblem withoutRows(StepProblem problem) {
  for (LinearRows* rows : {&problem.hard, &problem.within}) {
    rows->J.resize(0, rows->J.cols());
    rows->r.resize(0);
  }
  return problem;
}

std::string boundsIn(const std::vector<std::string>& names) {
  return "It would take " + listOf(names) + " beyond " + (names.size() == 1 ? "its bound." : "their bounds.");
}

}  // namespace

std::string SessionSolver::nothingMoves() const {
  if (goal_ < 0) return "No control moves what is nailed.";
  return "No control moves " +
         wordsOf(problem_.constraints.constraints()[static_cast<std::size_t>(goal_)]) + ".";
}

bool SessionSolver::isMoved() const {
  if (problem_.controls.size() == 0) return false;
  if (!differentiate(problem_, *start_)) return true;  // nobody knows
  return !stepProblem(*start_).soft.J.isZero(0);
}

SessionObstacle SessionSolver::obstacle() {
  if (reached()) return {};
  if (problem_.controls.size() == 0)
    return {Obstacle::no_control_moves_it, {}, "There are no controls."};
  return part_ ? part_->obstacleHere() : obstacleHere();
}

SessionObstacle SessionSolver::obstacleHere() {
  SessionObstacle out{Obstacle::no_control_moves_it, {}, nothingMoves()};
  if (problem_.controls.size() == 0) return out;
  const bool known = differentiate(problem_, *point_);
  if (!known) return {Obstacle::border, {}, "There are no derivatives there."};
  StepProblem problem = stepProblem(*point_);
  if (!point_->row_jacobian->allFinite()) return {Obstacle::border, {}, "There are no derivatives there."};
  problem.longest = kAnyLength;
  const bool nails_alone = goal_ < 0;
  if (nails_alone) std::swap(problem.hard, problem.soft);
  out.at_bounds = controlsAtBounds(problem_.controls, point_->changes.head(problem_.controls.size()));
  const auto is = [&](Obstacle kind, const std::string& sentence) {
    out.kind = kind, out.sentence = sentence;
    return out;
  };
  const auto goesOn = [&](const StepProblem& p) { return leaves(nails_alone ? kCouldGoOn : 1 - kCouldGoOn, p); };
  if (problem.soft.J.isZero(0)) return out;
  if (problem.soft.r.norm() <= options_.tolerance) return is(Obstacle::nails, "Not all nails are met.");
  if (goesOn(problem)) {
    const bool at_boundary = beyond_ && beyond_->signature != point_->signature;
    if (at_boundary) return is(Obstacle::border, describeBoundary(problem_, *point_, *beyond_));
    return is(Obstacle::work, "The work limit of one update was reached first.");
  }
  if (!out.at_bounds.empty() && goesOn(withoutBounds(problem))) return is(Obstacle::bounds, boundsIn(out.at_bounds));
  const StepProblem alone = withoutRows(problem);
  const bool bounded = !goesOn(alone);
  if (bounded && (out.at_bounds.empty() || !goesOn(withoutBounds(alone)))) {
    const bool against = nails_alone && problem.soft.size() > 1;
    if (against) return is(Obstacle::nails, "No small change of the controls brings all nails nearer to being met.");
    return is(Obstacle::no_control_moves_it, "No small change of the controls brings it nearer.");
  }
  if (!kinks_.empty() && problem.hard.size() == 0)
    return is(Obstacle::border, "A step nearer changes the impacts, and no trial got there.");
  const bool nothing_free = !hierarchicalStep(problem).free_for_soft;
  return is(Obstacle::nails, nothing_free ? "The nails leave no freedom to move it."
                                          : "The nails keep it from coming nearer.");
}

}  // namespace carom::editing_detail
