// SPDX-License-Identifier: MIT
// A body, or a nail, taken hold of and dragged about.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/session/session_state.hpp"
#include "editing/session/session_words.hpp"

namespace carom {
using namespace editing_detail;

namespace {

void requireFinite(const Vec3& v, const std::string& where) {
  if (v.allFinite()) return;
  throw InputError(where, "found [" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) +
                              "], expected three finite numbers");
}

void requireUnit(const Quat& q, const std::string& where) {
  if (std::abs(q.norm() - 1) <= 1e-3) return;
  throw InputError(where, "found a quaternion of length " + number(q.norm()) + ", expected 1");
}

bool isPlace(const Target& target) {
  return target.quantity == "position" || target.quantity == "point" || target.quantity == "contact";
}

/// The target of a nail that holds a place; -1 where there is none with a number.
int placeTargetOf(const Constraint& nail) {
  for (std::size_t i = 0; i < nail.targets.size(); ++i) {
    const Target& target = nail.targets[i];
    const auto is_number = [](const TargetNumber& v) { return !v.isFree(); };
    if (isPlace(target) && std::any_of(target.value.begin(), target.value.end(), is_number)) return static_cast<int>(i);
  }
  return -1;
}

int turnTargetOf(const Constraint& nail) {
  for (std::size_t i = 0; i < nail.targets.size(); ++i)
    if (nail.targets[i].quantity == "orientation") return static_cast<int>(i);
  return -1;
}

/// What a nail holds besides the place and the orientation that are dragged; without targets and regions: nothing.
Constraint restOf(Constraint nail, int place, int turn) {
  Target& held = nail.targets[static_cast<std::size_t>(place)];
  if (held.quantity == "contact") held.min = held.max = {};  // they move with it
  std::fill(held.value.begin(), held.value.end(), any);
  const auto at = [&](int i) { return nail.targets.begin() + i; };
  const bool has_range = !held.min.empty() || !held.max.empty();
  // from the back, so that indices stay
  for (int i = std::max(place, turn); i >= 0; --i)
    if ((i == place && !has_range) || i == turn) nail.targets.erase(at(i));
  return nail;
}

}  // namespace

std::vector<TargetNumber> editing_detail::constrainedPlace(const Vec3& place, const Grip& grip) {
  std::vector<TargetNumber> value{place.x(), place.y(), place.z()};
  if (grip.components.empty()) return value;
  const std::vector<std::string> names{"x", "y", "z"};
  for (const std::string& wanted : grip.components)
    if (std::find(names.begin(), names.end(), wanted) == names.end())
      throw InputError("grab/components", "found '" + wanted + "', expected " + listOf(names));
  for (std::size_t k = 0; k < 3; ++k)
    if (std::find(grip.components.begin(), grip.components.end(), names[k]) == grip.components.end()) value[k] = any;
  return value;
}

void editing_detail::putNail(Constraint& nail, const Vec3& place, const std::optional<Quat>& orientation) {
  std::vector<TargetNumber>& value = nail.targets[static_cast<std::size_t>(placeTargetOf(nail))].value;
  for (int k = 0; k < 3; ++k) {
    TargetNumber& held = value[static_cast<std::size_t>(k)];
    if (!held.isFree()) held = place[k];
  }
  if (orientation) nail.targets[static_cast<std::size_t>(turnTargetOf(nail))].value = numbersOf(*orientation);
}

std::vector<TargetNumber> editing_detail::numbersOf(const Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }

Constraint editing_detail::goalOf(const SessionDrag& drag) {
  const SessionGesture& record = drag.record;
  Constraint goal{record.body, record.at, {}};
  const std::vector<TargetNumber> place = constrainedPlace(drag.place, drag.held);
  if (!record.grip.place) {
    goal.targets.push_back({"orientation", numbersOf(*drag.orientation)});
    return goal;
  }
  if (record.grip.contact) {
    goal.targets.push_back(contactTarget(drag.place, drag.held, drag.sheet));
  } else if (record.grip.body_point) {
    goal.targets.push_back({"point", place, *record.grip.body_point});
  } else {
    goal.targets.push_back({"position", place});
  }
  if (drag.orientation) goal.targets.push_back({"orientation", numbersOf(*drag.orientation)});
  return goal;
}

std::string editing_detail::stepName(const SessionDrag& drag) {
  const std::string of = drag.record.grabbed_nail ? "drag of the nail of '" : "drag of '";
  return of + drag.record.body + "' " + wordsOf(drag.record.at);
}

std::unique_ptr<SessionSolver> EditSession::State::solverFor(const SessionMoment& moment,
                                                             const std::vector<Constraint>& constraints,
                                                             int goal) const {
  const bool from_start = options.measure_from == MeasureFrom::start;
  return std::make_unique<SessionSolver>(from_start ? *moment.reference : *moment.scene, contacts, moment.duration,
                                         moment.controls, constraints, goal,
                                         from_start ? moment.changes : Eigen::VectorXd(), options);
}

void EditSession::State::grab(const std::string& body, const When& at, const Grip& grip, std::vector<Control> also_vary,
                              AlsoVary wanted) {
  const BodyState state = stateAtMoment(*last.motion, body, at, "grab");
  SessionDrag next;
  next.record = newGesture(SessionGesture::Kind::drag);
  next.record.body = body, next.record.at = at, next.record.grip = next.held = grip;
  if (now.scene->bodies[static_cast<std::size_t>(bodyIndex(*now.scene, body))].fixed)
    throw InputError("grab", "found the fixed body '" + body + "', expected a moving body");
  if (!grip.place && !grip.orientation)
    throw InputError("grab", "found a grip that holds nothing, expected a position, an orientation or both");
  if (grip.body_point) requireFinite(*grip.body_point, "grab/body_point");
  if (grip.contact && (at.impact == 0 || grip.body_point || !grip.place))
    throw InputError("grab/contact", "found a time, another point or no position beside it, expected an impact alone");
  next.place = placeConstrained(*last.motion, next.record, "grab");
  if (grip.contact) next.sheet = sheetOf(*now.scene, next.record);
  if (grip.orientation) next.orientation = state.orientation;
  ConstrainedNails held = constrainedNails(now.nails);
  next.left_out = std::move(held.left_out);
  SessionMoment moment = now;
  std::unique_ptr<SessionSolver> solver;
  if (!also_vary.empty() && wanted == AlsoVary::where_nothing_moves_it) {
    std::vector<Constraint> all = held.constraints;
    all.push_back(goalOf(next));
    solver = solverFor(now, all, static_cast<int>(all.size()) - 1);
    if (solver->isMoved()) also_vary.clear();
  }
  if (!also_vary.empty()) {
    std::vector<Control> all = now.controls;
    all.insert(all.end(), also_vary.begin(), also_vary.end());
    next.record.controls = std::move(also_vary);
    moment.setControls(std::move(all));
    solver.reset();
  }
  beginDrag(std::move(next), std::move(moment), std::move(held.constraints), std::move(solver));
}

void EditSession::State::grabNail(NailId id) {
  const Constraint& nail = nailOf(id).constraint;
  const auto refuse = [](const std::string& found, const std::string& expected) {
    throw InputError("grabNail", "found a nail " + found + ", expected one " + expected);
  };
  if (nail.at.span) refuse("at some time of a span", "at a time, an impact or rest: setNail moves the others");
  if (!nail.relative_to.empty())
    refuse("relative to '" + nail.relative_to + "'", "relative to the world: setNail moves the others");
  const int place = placeTargetOf(nail), turn = turnTargetOf(nail);
  if (place < 0) refuse("without a position", "with a position or a point: setNail moves the others");
  SessionDrag next;
  next.record = newGesture(SessionGesture::Kind::drag);
  next.record.grabbed_nail = id.value;
  next.record.body = nail.body, next.record.at = nail.at;
  Grip& grip = next.record.grip;
  const Target& target = nail.targets[static_cast<std::size_t>(place)];
  if (target.quantity == "point") grip.body_point = target.body_point;
  grip.contact = target.quantity == "contact";
  next.place = placeConstrained(*last.motion, next.record, "grabNail");
  for (int k = 0; k < 3; ++k) {
    const TargetNumber& value = target.value[static_cast<std::size_t>(k)];
    if (value.isFree()) continue;
    next.place[k] = value;
    grip.components.push_back(std::string(1, "xyz"[k]));
  }
  if (grip.components.size() == 3) grip.components.clear();
  if (turn >= 0) {
    const std::vector<TargetNumber>& q = nail.targets[static_cast<std::size_t>(turn)].value;
    grip.orientation = true;
    next.orientation = Quat(q[0], q[1], q[2], q[3]);
  }
  next.held = grip;
  std::vector<SessionNail> others = now.nails;
  std::erase_if(others, [&](const SessionNail& other) { return other.id == id; });
  ConstrainedNails held = constrainedNails(others);
  next.left_out = std::move(held.left_out);
  Constraint rest = restOf(nail, place, turn);
  if (!rest.targets.empty() || !rest.regions.empty()) held.constraints.push_back(std::move(rest));
  beginDrag(std::move(next), now, std::move(held.constraints));
}

void EditSession::State::beginDrag(SessionDrag next, SessionMoment moment, std::vector<Constraint> held,
                                   std::unique_ptr<SessionSolver> solver) {
  const auto began_at = Clock::now();
  held.push_back(goalOf(next));
  next.record.constraint = held.back();
  if (next.orientation) next.turn_target = static_cast<int>(held.back().targets.size()) - 1;
  next.solver = solver ? std::move(solver) : solverFor(moment, held, static_cast<int>(held.size()) - 1);
  next.solver->takeOverFrom(last.motion);
  next.before = last.motion;
  next.began = std::move(now);
  now = std::move(moment);
  drag = std::move(next);
  stay("", last.motion);
  measureDrag(last);
  last.milliseconds = millisecondsSince(began_at);
}

SessionUpdate EditSession::State::dragTo(const Vec3& place, const std::optional<Quat>& orientation,
                                         std::stop_token stop) {
  if (!drag) throw InputError("dragTo", "found no grabbed body, expected grab before it");
  requireFinite(place, "dragTo");
  if (orientation && !drag->orientation)
    throw InputError("dragTo", "found an orientation, expected a grip that holds it (Grip::orientation)");
  if (orientation) requireUnit(*orientation, "dragTo");

  drag->place = place;
  if (drag->held.contact) drag->solver->aim(0, contactTarget(place, drag->held, drag->sheet));
  else if (drag->held.place) drag->solver->aim(0, constrainedPlace(place, drag->held));
  if (orientation) {
    drag->orientation = orientation;
    drag->solver->aim(drag->turn_target, numbersOf(*orientation));
  }
  if (drag->record.grabbed_nail) putNail(nailOf({*drag->record.grabbed_nail}).constraint, place, drag->orientation);
  DragTarget target;
  target.place = place, target.orientation = orientation;
  if (drag->held.contact && isOnSheet(drag->held)) target.components = drag->held.components;
  return follow(std::move(target), budget(options.drag_simulations, options.drag_seconds, std::move(stop)), {});
}

void EditSession::State::slide(const Vec3& place, const std::vector<std::string>& components) {
  if (!drag || !drag->held.contact || drag->held.components.size() == 1)
    throw InputError("slideTo", "found no grabbed contact, or one component of it, expected one (Grip::contact)");
  Grip held = drag->held;
  held.components = components;
  constrainedPlace(place, held);  // throws for components that there are not
  if (!isOnSheet(held) || components[0] == components[1])
    throw InputError("slideTo/components", "found " + listOf(components) + ", expected two of x, y and z");
  requireFinite(place, "slideTo");
  drag->held = std::move(held);
}

SessionUpdate EditSession::State::dwell(std::stop_token stop, const Better& better) {
  if (!drag) throw InputError("dwell", "found no grabbed body, expected grab before it");
  DragTarget target;
  target.place = drag->place;
  target.dwell = true;
  const double no_clock = std::numeric_limits<double>::infinity();
  return follow(std::move(target), budget(options.dwell_simulations, no_clock, std::move(stop)), better);
}

SessionUpdate EditSession::State::follow(DragTarget target, Budget budget, const Better& better) {
  const auto began_at = Clock::now();
  SessionSolver& solver = *drag->solver;
  const EditPointPtr from = solver.point();
  const int steps = solver.iterations();
  const std::shared_ptr<const Motion> shown = last.motion;
  EditPointPtr seen = from;
  std::shared_ptr<const Motion> of_seen = last.motion;
  const auto measured = [&] {
    SessionUpdate update;
    if (solver.point() != seen) seen = solver.point(), of_seen = solver.atStart() ? drag->before : motionOf(solver);
    update.motion = of_seen;
    update.moved = update.motion != shown;
    update.iterations = solver.iterations() - steps;
    update.simulations = budget.done();
    if (solver.point() != from)
      update.stage = update.iterations == 1 ? SessionStage::predicted : SessionStage::improved;
    measureGoal(solver, update);
    measureDrag(update);
    return update;
  };
  std::exception_ptr failure;
  const auto tell = [&] {
    if (failure) return;
    try {
      SessionUpdate update = measured();
      compareImpacts(solver, *drag->before, update);
      update.milliseconds = millisecondsSince(began_at);
      better(update);
    } catch (...) {
      failure = std::current_exception();
      budget.end(Halt::cancelled);
    }
  };
  solver.improve(budget, better ? std::function<void()>(tell) : std::function<void()>(), !target.dwell);

  SessionUpdate update = measured();
  putEnd(budget, update);
  describe(solver, *drag->before, "", update);
  target.milliseconds = millisecondsSinceStart();
  target.cut_after = budget.cutAfter();
  drag->record.targets.push_back(std::move(target));
  update.milliseconds = millisecondsSince(began_at);
  last = std::move(update);
  if (failure) std::rethrow_exception(failure);
  return last;
}

}  // namespace carom
