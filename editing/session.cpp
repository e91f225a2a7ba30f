// SPDX-License-Identifier: MIT
#include "editing/session.h"

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/base/names.hpp"
#include "adjoint/simulate/simulate.h"
#include "editing/detail/messages.hpp"
#include "editing/session/session_state.hpp"
#include "editing/session_numbers.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

const char* nameOf(SessionStage stage) {
  return nameIn({"kept", "predicted", "improved", "solved"}, stage);
}

std::vector<Constraint> editing_detail::SessionMoment::constraints() const {
  std::vector<Constraint> all;
  for (const SessionNail& nail : nails) all.push_back(nail.constraint);
  return all;
}

EditSession::State::State(ContactSource& source, double length, const SessionOptions& chosen)
    : contacts(source), duration(length), options(chosen) {}

SessionGesture EditSession::State::newGesture(SessionGesture::Kind kind) const {
  SessionGesture gesture;
  gesture.kind = kind;
  gesture.milliseconds = millisecondsSinceStart();
  return gesture;
}

double EditSession::State::millisecondsSinceStart() const {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
}

Budget EditSession::State::budget(int limit, double seconds) const {
  return replays ? Budget::replayed(limit, replayed_cut) : Budget(limit, seconds);
}

void EditSession::State::requireNoDrag(const char* call) const {
  if (drag) throw InputError(call, "found '" + drag->record.body + "' grabbed, expected release or cancel before it");
}

namespace {

void checkOptions(const SessionOptions& options) {
  const auto check = [](const char* name, double value, bool good, const char* expected) {
    if (!good) throw InputError(std::string("/options/") + name, "found " + number(value) + ", expected " + expected);
  };
  check("tolerance", options.tolerance, options.tolerance > 0 && std::isfinite(options.tolerance), "a number > 0");
  check("drag_simulations", options.drag_simulations, options.drag_simulations >= 0, "0 or more");
  check("release_iterations", options.release_iterations, options.release_iterations >= 0, "0 or more");
  check("drag_seconds", options.drag_seconds, options.drag_seconds >= 0, "a number >= 0");
  check("release_seconds", options.release_seconds, options.release_seconds >= 0, "a number >= 0");
}

}  // namespace

void EditSession::State::begin(const Scene& scene, std::vector<Control> controls, std::vector<Constraint> nails) {
  checkOptions(options);
  const EditProblem checked(scene, contacts, duration, controls, nails);
  journal = {scene, duration, controls, nails, options, {}};
  now.scene = now.reference = std::make_shared<const Scene>(scene);
  now.controls = std::move(controls);
  for (Constraint& nail : nails) now.nails.push_back({{next_nail++}, std::move(nail)});
  last.motion = simulated(now.scene);
  last.message = earlyEnd(*last.motion);
  measureNails(last);
}

void EditSession::State::remember(SessionMoment before) {
  past.push_back(std::move(before));
  future.clear();
}

EditSession::EditSession(const Scene& scene, ContactSource& contacts, double duration, const SessionOptions& options)
    : EditSession(scene, contacts, duration, {}, {}, options) {}

EditSession::EditSession(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
                         std::vector<Constraint> nails, const SessionOptions& options)
    : state_(std::make_unique<State>(contacts, duration, options)) {
  state_->begin(scene, std::move(controls), std::move(nails));
}

EditSession::~EditSession() = default;
EditSession::EditSession(EditSession&&) noexcept = default;
EditSession& EditSession::operator=(EditSession&&) noexcept = default;

void EditSession::setControls(std::vector<Control> controls) {
  State& s = *state_;
  s.requireNoDrag("setControls");
  const ControlSet checked(*s.now.scene, controls);
  SessionGesture gesture = s.newGesture(SessionGesture::Kind::controls);
  gesture.controls = controls;
  s.remember(s.now);
  s.now.controls = std::move(controls);
  s.now.reference = s.now.scene;
  s.now.changes.resize(0);
  s.stay("");
  s.record(std::move(gesture));
}

NailId EditSession::nail(Constraint constraint) {
  state_->requireNoDrag("nail");
  return state_->addNail(std::move(constraint));
}

NailId EditSession::nailAsItIs(const std::string& body, When at) {
  const BodyState state = stateAtMoment(motion(), body, at, "nailAsItIs");
  return nail(heldConstraint(body, at, {.position = state.position, .orientation = state.orientation}));
}

void EditSession::unnail(NailId id) {
  State& s = *state_;
  s.requireNoDrag("unnail");
  constraintOf(id);
  SessionGesture gesture = s.newGesture(SessionGesture::Kind::unnail);
  gesture.nail = id.value;
  s.remember(s.now);
  std::erase_if(s.now.nails, [&](const SessionNail& nail) { return nail.id == id; });
  s.stay("");
  s.record(std::move(gesture));
}

SessionUpdate EditSession::grab(const std::string& body, When at, const Grip& grip) {
  state_->requireNoDrag("grab");
  state_->grab(body, at, grip);
  return last();
}

SessionUpdate EditSession::dragTo(const Vec3& place) { return state_->dragTo(place, std::nullopt); }
SessionUpdate EditSession::dragTo(const Vec3& place, const Quat& orientation) {
  return state_->dragTo(place, orientation);
}
SessionUpdate EditSession::release() { return state_->endDrag(SessionGesture::Ending::release); }
SessionUpdate EditSession::releaseNailed() { return state_->endDrag(SessionGesture::Ending::release_nailed); }
SessionUpdate EditSession::cancel() { return state_->endDrag(SessionGesture::Ending::cancel); }

bool EditSession::isGrabbed() const { return state_->drag.has_value(); }

namespace {

const SessionDrag& requireDrag(const std::optional<SessionDrag>& drag, const char* call) {
  if (!drag) throw InputError(call, "found no grabbed body, expected grab before it");
  return *drag;
}

}  // namespace

Vec3 EditSession::grabbedPlace() const {
  const SessionGesture& record = requireDrag(state_->drag, "grabbedPlace").record;
  const BodyState state = stateAtMoment(motion(), record.body, record.at, "grabbedPlace");
  return state.position + state.orientation * record.grip.body_point.value_or(Vec3::Zero());
}

Quat EditSession::grabbedOrientation() const {
  const SessionGesture& record = requireDrag(state_->drag, "grabbedOrientation").record;
  return stateAtMoment(motion(), record.body, record.at, "grabbedOrientation").orientation;
}

SessionUpdate EditSession::State::stay(const std::string& message) {
  const auto began_at = std::chrono::steady_clock::now();
  SessionUpdate update;
  update.motion = last.motion;
  update.message = message.empty() ? earlyEnd(*update.motion) : message;
  measureNails(update);
  update.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began_at).count();
  return last = std::move(update);
}

SessionUpdate EditSession::State::goTo(std::vector<SessionMoment>& from, std::vector<SessionMoment>& to,
                                       SessionGesture::Kind kind) {
  const bool back = kind == SessionGesture::Kind::undo;
  if (from.empty()) return stay(back ? "There is nothing to undo." : "There is nothing to redo.");
  SessionGesture gesture = newGesture(kind);
  const bool other_scene = from.back().scene != now.scene;
  if (other_scene) last.motion = simulated(from.back().scene);
  to.push_back(std::move(now));
  now = std::move(from.back());
  from.pop_back();
  stay("");
  record(std::move(gesture));
  return last;
}

SessionUpdate EditSession::undo() {
  if (state_->drag) return cancel();
  return state_->goTo(state_->past, state_->future, SessionGesture::Kind::undo);
}

SessionUpdate EditSession::redo() {
  state_->requireNoDrag("redo");
  return state_->goTo(state_->future, state_->past, SessionGesture::Kind::redo);
}

bool EditSession::canUndo() const { return state_->drag || !state_->past.empty(); }
bool EditSession::canRedo() const { return !state_->drag && !state_->future.empty(); }

const SessionUpdate& EditSession::last() const { return state_->last; }
double EditSession::duration() const { return state_->duration; }
const std::vector<Control>& EditSession::controls() const { return state_->now.controls; }
const SessionOptions& EditSession::options() const { return state_->options; }
const SessionJournal& EditSession::journal() const { return state_->journal; }

std::vector<Constraint> EditSession::constraints() const {
  return state_->drag ? state_->drag->solver->problem().constraints.constraints() : state_->now.constraints();
}

std::vector<NailId> EditSession::nails() const {
  std::vector<NailId> ids;
  for (const SessionNail& nail : state_->now.nails) ids.push_back(nail.id);
  return ids;
}

const Constraint& EditSession::constraintOf(NailId id) const {
  std::vector<std::string> there;
  for (const SessionNail& nail : state_->now.nails) {
    if (nail.id == id) return nail.constraint;
    there.push_back(std::to_string(nail.id.value));
  }
  throw InputError("nail " + std::to_string(id.value),
                   "found a nail that is not there, expected " + (there.empty() ? "none" : "one of " + listOf(there)));
}

void EditSession::State::record(SessionGesture gesture) {
  gesture.reached = last.reached;
  gesture.distance = last.distance;
  for (const SessionNumber& number : sessionNumbers(*now.scene, now.controls)) gesture.numbers.push_back(number.value);
  journal.gestures.push_back(std::move(gesture));
}

}  // namespace carom
