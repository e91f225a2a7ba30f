// SPDX-License-Identifier: MIT
// Nails: how they stand, and gestures that solve for them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/problem/rows/constraint_checks.hpp"
#include "editing/problem/rows/instants.hpp"
#include "editing/problem/rows/nearest_instants.hpp"
#include "editing/problem/rows/required_impacts.hpp"
#include "editing/session/session_state.hpp"
#include "editing/session/session_words.hpp"

namespace carom {
using namespace editing_detail;

namespace {

constexpr std::size_t kNamedNails = 3;

std::string whyMissing(const Constraint& nail, const Motion& motion) {
  if (nail.at.impact > 0 || nail.at.rest) return describeLack(nail.at, nail.body) + ".";
  return "The motion ends at " + brief(motion.end) + " s, before it.";
}

/// "position.x is off by 0.012 m."
std::string worstOf(const ConstraintSet& set, const RowValues& rows) {
  Eigen::Index worst = 0;
  rows.scaled.cwiseAbs().maxCoeff(&worst);
  const Row& row = set.rows()[static_cast<std::size_t>(worst)];
  return row.name + " is off by " + brief(std::abs(rows.residuals[worst])) + unitOf(row) + ".";
}

double timeOf(const ConstraintSet& set, const RowValues& rows, const Motion& motion) {
  const Constraint& nail = set.constraints()[0];
  if (requiresImpacts(nail)) return set.extentIn(motion).time;
  if (nail.targets.empty()) return set.timeOfClearance(motion, 0).value_or(0);
  if (nail.at.span) return rows.times[0];
  const auto instant = findInstant(motion, bodyIndex(*motion.scene, nail.body), nail.at);
  return instant ? editing_detail::timeOf(motion, *instant) : std::numeric_limits<double>::quiet_NaN();
}

NailState stateIn(const Scene& scene, const Motion& motion, const Constraint& constraint, double duration,
                  double tolerance) {
  NailState state;
  state.soft = constraint.soft.has_value();
  Constraint exact = constraint;
  exact.soft.reset();
  const ConstraintSet set(scene, {exact}, duration);
  const RowValues rows = set.evaluate(motion, nearestInstants(set, motion));
  if (!rows.available) {
    state.available = state.met = false;
    state.time = state.error = state.scaled_error = std::numeric_limits<double>::quiet_NaN();
    state.message = requiresImpacts(constraint) ? rows.message : whyMissing(constraint, motion);
    return state;
  }
  state.time = timeOf(set, rows, motion);
  state.met = true;
  if (set.size() == 0) return state;
  state.error = rows.residuals.cwiseAbs().maxCoeff();
  state.scaled_error = rows.scaled.cwiseAbs().maxCoeff();
  state.met = state.scaled_error <= tolerance;
  if (!state.met) state.message = worstOf(set, rows);
  return state;
}

}  // namespace

NailState nailStateIn(const Motion& motion, const Constraint& constraint, double duration, double tolerance) {
  return stateIn(*motion.scene, motion, constraint, duration, tolerance);
}

SessionNail& EditSession::State::nailOf(NailId id) {
  if (SessionNail* nail = now.find(id)) return *nail;
  std::vector<std::string> there;
  for (const SessionNail& nail : now.nails) there.push_back(std::to_string(nail.id.value));
  throw InputError("nail " + std::to_string(id.value),
                   "found a nail that is not there, expected " + (there.empty() ? "none" : "one of " + listOf(there)));
}

NailState EditSession::State::stateOf(const SessionNail& nail, const Motion& motion) const {
  NailState state = stateIn(*now.scene, motion, nail.constraint, now.duration, options.tolerance);
  state.id = nail.id, state.on = nail.on;
  return state;
}

ConstrainedNails EditSession::State::constrainedNails(const std::vector<SessionNail>& nails) const {
  ConstrainedNails held;
  std::vector<std::string> missing;
  for (const SessionNail& nail : nails) {
    if (!nail.on) continue;
    if (stateOf(nail, *last.motion).available) {
      held.constraints.push_back(nail.constraint);
    } else {
      missing.push_back(wordsOf(nail.constraint));
    }
  }
  if (missing.empty()) return held;
  const std::size_t count = missing.size();
  if (count > kNamedNails) {
    missing.resize(kNamedNails);
    missing.push_back(std::to_string(count - kNamedNails) + " more");
  }
  held.left_out = "The motion cannot evaluate " + std::string(count == 1 ? "a nail" : "nails") + ", which a gesture ignores: " +
                  listOf(missing) + ".";
  return held;
}

SessionUpdate EditSession::State::solveStep(NailStep step, SessionGesture gesture, std::stop_token stop) {
  const auto began_at = Clock::now();
  const std::unique_ptr<SessionSolver> solver = solverFor(step.next, step.held.constraints, step.goal);
  Budget budget = this->budget(options.drag_simulations, options.release_seconds, std::move(stop));
  SessionUpdate update;
  if (!solver->reached() || solver->problem().isLeastSquares()) {
    solver->improve(budget);
    update.simulations = budget.done();
    budget.allow(options.release_iterations);
    solver->finish(budget);
  }
  const std::shared_ptr<const Motion> shown = last.motion;
  update.motion = solver->atStart() ? shown : motionOf(*solver);
  update.moved = update.motion != shown;
  update.stage = solver->atStart() ? SessionStage::kept : SessionStage::solved;
  update.iterations = solver->iterations();
  putEnd(budget, update);
  gesture.cut_after = budget.cutAfter();
  measureGoal(*solver, update);
  describe(*solver, *shown, step.held.left_out, update);
  const std::shared_ptr<const Scene> began = now.scene;
  if (step.changes_nails || !solver->atStart()) remember(std::move(now), std::move(step.name));
  now = std::move(step.next);
  now.asked = AskedFor{began};
  takeOver(*solver, update);
  update.milliseconds = millisecondsSince(began_at);
  last = std::move(update);
  record(std::move(gesture));
  return last;
}

NailId EditSession::State::addNail(Constraint constraint, std::stop_token stop) {
  SessionGesture gesture = newGesture(SessionGesture::Kind::nail);
  gesture.constraint = constraint;
  const NailId id{next_nail};
  gesture.nail = id.value;
  NailStep step{now, constrainedNails(now.nails), -1, "nail of " + wordsOf(constraint), true};
  step.held.constraints.push_back(constraint);
  step.goal = static_cast<int>(step.held.constraints.size()) - 1;
  step.next.nails.push_back({id, std::move(constraint)});
  solveStep(std::move(step), std::move(gesture), std::move(stop));
  ++next_nail;
  return id;
}

void EditSession::State::setNail(NailId id, Constraint constraint, std::stop_token stop) {
  const SessionNail& nail = nailOf(id);
  SessionGesture gesture = newGesture(SessionGesture::Kind::set_nail);
  gesture.constraint = constraint;
  gesture.nail = id.value;
  NailStep step{now, {}, -1, "change of the nail of " + wordsOf(nail.constraint), true};
  const bool on = nail.on;
  step.next.find(id)->constraint = constraint;
  if (!on) {
    const ConstraintSet checked(*now.scene, {constraint}, now.duration);
    const SoftTerms checked_soft(*now.scene, {constraint}, now.duration);
    remember(std::move(now), std::move(step.name));
    now = std::move(step.next);
    stay("", last.motion);
    record(std::move(gesture));
    return;
  }
  std::vector<SessionNail> others = now.nails;
  std::erase_if(others, [&](const SessionNail& other) { return other.id == id; });
  step.held = constrainedNails(others);
  step.held.constraints.push_back(std::move(constraint));
  step.goal = static_cast<int>(step.held.constraints.size()) - 1;
  solveStep(std::move(step), std::move(gesture), std::move(stop));
}

SessionUpdate EditSession::State::meetNails(std::stop_token stop) {
  NailStep step{now, {}, -1, "meeting all nails", false};
  for (SessionNail& nail : step.next.nails) {
    step.changes_nails = step.changes_nails || !nail.on;
    nail.on = true;
  }
  step.held = constrainedNails(step.next.nails);
  return solveStep(std::move(step), newGesture(SessionGesture::Kind::meet_nails), std::move(stop));
}

}  // namespace carom
