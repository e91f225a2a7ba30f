// SPDX-License-Identifier: MIT
// Gestures that solve: a body dragged about, a nail added.
#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/session/session_state.hpp"

namespace carom {
using namespace editing_detail;

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void requireFinite(const Vec3& v, const std::string& where) {
  if (v.allFinite()) return;
  throw InputError(where, "found [" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) +
                              "], expected three finite numbers");
}

void requireUnit(const Quat& q, const std::string& where) {
  if (std::abs(q.norm() - 1) <= 1e-3) return;
  throw InputError(where, "found a quaternion of length " + number(q.norm()) + ", expected 1");
}

/// The components of a place that a grip holds.
std::vector<double> heldPlace(const Vec3& place, const Grip& grip) {
  std::vector<double> value{place.x(), place.y(), place.z()};
  if (grip.components.empty()) return value;
  const std::vector<std::string> names{"x", "y", "z"};
  for (const std::string& wanted : grip.components)
    if (std::find(names.begin(), names.end(), wanted) == names.end())
      throw InputError("grab/components", "found '" + wanted + "', expected " + listOf(names));
  for (std::size_t k = 0; k < 3; ++k)
    if (std::find(grip.components.begin(), grip.components.end(), names[k]) == grip.components.end()) value[k] = any;
  return value;
}

std::vector<double> numbersOf(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }

Constraint goalOf(const SessionDrag& drag) {
  const SessionGesture& record = drag.record;
  Constraint goal{record.body, record.at, {}};
  const std::vector<double> place = heldPlace(drag.place, record.grip);
  if (record.grip.body_point) {
    goal.targets.push_back({"point", place, *record.grip.body_point});
  } else {
    goal.targets.push_back({"position", place});
  }
  if (drag.orientation) goal.targets.push_back({"orientation", numbersOf(*drag.orientation)});
  return goal;
}

}  // namespace

std::unique_ptr<SessionSolver> EditSession::State::solverFor(const std::vector<Constraint>& constraints,
                                                             int goal) const {
  const bool from_start = options.measure_from == MeasureFrom::start;
  return std::make_unique<SessionSolver>(from_start ? *now.reference : *now.scene, contacts, duration, now.controls,
                                         constraints, goal, from_start ? now.changes : Eigen::VectorXd(), options);
}

void EditSession::State::grab(const std::string& body, const When& at, const Grip& grip) {
  const auto began_at = Clock::now();
  const BodyState state = stateAtMoment(*last.motion, body, at, "grab");
  SessionDrag next;
  next.record.kind = SessionGesture::Kind::drag;
  next.record.milliseconds = millisecondsSinceStart();
  next.record.body = body, next.record.at = at, next.record.grip = grip;
  next.body = bodyIndex(*now.scene, body);
  next.with = at.with.empty() ? -1 : bodyIndex(*now.scene, at.with);
  if (now.scene->bodies[static_cast<std::size_t>(next.body)].fixed)
    throw InputError("grab", "found the fixed body '" + body + "', expected a moving body");
  if (grip.body_point) requireFinite(*grip.body_point, "grab/body_point");
  next.place = state.position + state.orientation * grip.body_point.value_or(Vec3::Zero());
  if (grip.orientation) next.orientation = state.orientation;
  std::vector<Constraint> constraints = now.constraints();
  constraints.push_back(goalOf(next));
  next.record.constraint = constraints.back();
  if (next.orientation) next.turn_target = static_cast<int>(constraints.back().targets.size()) - 1;
  next.solver = solverFor(constraints, static_cast<int>(constraints.size()) - 1);
  next.before = last.motion;
  drag = std::move(next);
  stay("");
  measureDrag(last);
  last.milliseconds = millisecondsSince(began_at);
}

SessionUpdate EditSession::State::dragTo(const Vec3& place, const std::optional<Quat>& orientation) {
  const auto began_at = Clock::now();
  if (!drag) throw InputError("dragTo", "found no grabbed body, expected grab before it");
  requireFinite(place, "dragTo");
  if (orientation && !drag->orientation)
    throw InputError("dragTo", "found an orientation, expected a grip that holds it (Grip::orientation)");
  if (orientation) requireUnit(*orientation, "dragTo");

  drag->place = place;
  drag->solver->aim(0, heldPlace(place, drag->record.grip));
  if (orientation) {
    drag->orientation = orientation;
    drag->solver->aim(drag->turn_target, numbersOf(*orientation));
  }
  SessionSolver& solver = *drag->solver;
  const EditPointPtr from = solver.point();
  const int steps = solver.iterations();
  Budget budget = this->budget(options.drag_simulations, options.drag_seconds);
  solver.improve(budget);

  SessionUpdate update;
  update.motion = solver.atStart() ? drag->before : solver.point() == from ? last.motion : motionOf(solver);
  update.iterations = solver.iterations() - steps;
  update.simulations = budget.done();
  update.cut_by_clock = budget.cutAfter().has_value();
  if (solver.point() != from) {
    update.stage = update.iterations == 1 ? SessionStage::predicted : SessionStage::improved;
  }
  measureGoal(solver, update);
  measureDrag(update);
  describe(solver, update);
  DragTarget target{millisecondsSinceStart(), place, orientation, std::nullopt};
  target.cut_after = budget.cutAfter();
  drag->record.targets.push_back(target);
  update.milliseconds = millisecondsSince(began_at);
  return last = std::move(update);
}

SessionUpdate EditSession::State::endDrag(SessionGesture::Ending ending) {
  const auto began_at = Clock::now();
  const char* const kCalls[] = {"release", "releaseNailed", "cancel"};
  if (!drag) throw InputError(kCalls[static_cast<int>(ending)], "found no grabbed body, expected grab before it");
  SessionDrag ended = std::move(*drag);
  ended.record.ending = ending;
  if (ending == SessionGesture::Ending::cancel) {
    drag.reset();
    last.motion = ended.before;
    stay("");
  } else {
    Budget budget = this->budget(options.release_iterations, options.release_seconds);
    SessionSolver& solver = *ended.solver;
    const EditPointPtr from = solver.point();
    const int steps = solver.iterations();
    if (!ended.record.targets.empty()) solver.finish(budget);
    SessionUpdate update;
    update.motion = solver.point() == from ? last.motion : motionOf(solver);
    update.stage = solver.atStart() ? SessionStage::kept : SessionStage::solved;
    update.iterations = solver.iterations() - steps;
    update.cut_by_clock = budget.cutAfter().has_value();
    ended.record.cut_after = budget.cutAfter();
    measureGoal(solver, update);
    drag = std::move(ended);  // where the distance is measured
    measureDrag(update);
    describe(solver, update);
    ended = std::move(*drag);
    drag.reset();
    const bool nails = ending == SessionGesture::Ending::release_nailed;
    if (nails || !ended.solver->atStart()) {
      remember(now);
      takeOver(*ended.solver, update);
    }
    if (nails) {
      ended.record.nail = next_nail;
      now.nails.push_back({{next_nail++}, goalOf(ended)});
    }
    last = std::move(update);
  }
  last.milliseconds = millisecondsSince(began_at);
  record(std::move(ended.record));
  return last;
}

NailId EditSession::State::addNail(Constraint constraint) {
  const auto began_at = Clock::now();
  SessionGesture gesture = newGesture(SessionGesture::Kind::nail);
  gesture.constraint = constraint;
  gesture.nail = next_nail;
  std::vector<Constraint> constraints = now.constraints();
  constraints.push_back(constraint);
  const std::unique_ptr<SessionSolver> solver = solverFor(constraints, static_cast<int>(constraints.size()) - 1);

  Budget fast(options.drag_simulations);
  Budget budget = this->budget(options.release_iterations, options.release_seconds);
  if (!solver->reached()) {
    solver->improve(fast);
    solver->finish(budget);
  }
  SessionUpdate update;
  update.motion = solver->atStart() ? last.motion : motionOf(*solver);
  update.stage = solver->atStart() ? SessionStage::kept : SessionStage::solved;
  update.iterations = solver->iterations();
  update.simulations = fast.done();
  update.cut_by_clock = budget.cutAfter().has_value();
  gesture.cut_after = budget.cutAfter();
  remember(now);
  now.nails.push_back({{next_nail++}, std::move(constraint)});
  if (!solver->atStart()) takeOver(*solver, update);
  measureGoal(*solver, update);
  describe(*solver, update);
  update.milliseconds = millisecondsSince(began_at);
  last = std::move(update);
  const NailId id{gesture.nail};
  record(std::move(gesture));
  return id;
}

}  // namespace carom
