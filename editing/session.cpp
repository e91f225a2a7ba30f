// SPDX-License-Identifier: MIT
#include "editing/session.h"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/session/session_state.hpp"
#include "editing/session/session_words.hpp"

namespace carom {

using namespace editing_detail;

double editing_detail::millisecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

EditSession::State::State(ContactSource& source, const SessionOptions& chosen) : contacts(source), options(chosen) {}

SessionGesture EditSession::State::newGesture(SessionGesture::Kind kind) const {
  SessionGesture gesture;
  gesture.kind = kind;
  gesture.milliseconds = millisecondsSinceStart();
  return gesture;
}

double EditSession::State::millisecondsSinceStart() const { return millisecondsSince(started); }

Budget EditSession::State::budget(int limit, double seconds, std::stop_token stop) const {
  return replays ? Budget::replayed(limit, replayed_cut) : Budget(limit, seconds, std::move(stop));
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
  check("dwell_simulations", options.dwell_simulations, options.dwell_simulations >= 0, "0 or more");
  check("release_iterations", options.release_iterations, options.release_iterations >= 0, "0 or more");
  check("drag_seconds", options.drag_seconds, options.drag_seconds >= 0, "a number >= 0");
  check("release_seconds", options.release_seconds, options.release_seconds >= 0, "a number >= 0");
  check("drag_steps", options.drag_steps, options.drag_steps >= 0, "a number >= 0");
  check("release_steps", options.release_steps, options.release_steps >= 0, "a number >= 0");
}

}  // namespace

void EditSession::State::begin(const Scene& scene, double duration, std::vector<Control> controls,
                               std::vector<Constraint> nails) {
  checkOptions(options);
  const EditProblem checked(scene, contacts, duration, controls, nails);
  journal = {scene, duration, controls, nails, options, {}};
  now.scene = now.reference = std::make_shared<const Scene>(scene);
  now.duration = duration;
  now.controls = std::move(controls);
  for (Constraint& nail : nails) now.nails.push_back({{next_nail++}, std::move(nail)});
  last.motion = simulated(now.scene, now.duration);
  if (options.unmet_nails_off)
    for (SessionNail& nail : now.nails) nail.on = stateOf(nail, *last.motion).met;
  stay("", last.motion);
}

EditSession::EditSession(const Scene& scene, ContactSource& contacts, double duration, const SessionOptions& options)
    : EditSession(scene, contacts, duration, {}, {}, options) {}

EditSession::EditSession(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
                         std::vector<Constraint> nails, const SessionOptions& options)
    : state_(std::make_unique<State>(contacts, options)) {
  state_->begin(scene, duration, std::move(controls), std::move(nails));
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
  s.remember(s.now, "change of the controls");
  s.now.setControls(std::move(controls));
  s.stay("", s.last.motion);
  s.record(std::move(gesture));
}

NailId EditSession::nail(Constraint constraint, std::stop_token stop) {
  state_->requireNoDrag("nail");
  return state_->addNail(std::move(constraint), std::move(stop));
}

NailId EditSession::nailAsItIs(const std::string& body, When at) {
  const BodyState state = stateAtMoment(motion(), body, at, "nailAsItIs");
  return nail(nailConstraint(body, at, {.position = state.position, .orientation = state.orientation}));
}

void EditSession::setNail(NailId id, Constraint constraint, std::stop_token stop) {
  state_->requireNoDrag("setNail");
  state_->setNail(id, std::move(constraint), std::move(stop));
}

void EditSession::setNailOn(NailId id, bool on) {
  State& s = *state_;
  s.requireNoDrag("setNailOn");
  const std::string name = wordsOf(s.nailOf(id).constraint);
  SessionGesture gesture = s.newGesture(SessionGesture::Kind::nail_on);
  gesture.nail = id.value, gesture.on = on;
  s.remember(s.now, "nail of " + name + (on ? " switched on" : " switched off"));
  s.nailOf(id).on = on;
  s.stay("", s.last.motion);
  s.record(std::move(gesture));
}

void EditSession::keepSequence(bool keep) {
  State& s = *state_;
  s.requireNoDrag("keepSequence");
  SessionGesture gesture = s.newGesture(SessionGesture::Kind::keep_sequence);
  gesture.on = keep;
  s.options.sequence = keep ? SequencePolicy::stay : SequencePolicy::prefer_start;
  s.stay("", s.last.motion);
  s.record(std::move(gesture));
}

SessionUpdate EditSession::meetNails(std::stop_token stop) {
  state_->requireNoDrag("meetNails");
  return state_->meetNails(std::move(stop));
}

void EditSession::unnail(NailId id) {
  State& s = *state_;
  s.requireNoDrag("unnail");
  const std::string name = wordsOf(s.nailOf(id).constraint);
  SessionGesture gesture = s.newGesture(SessionGesture::Kind::unnail);
  gesture.nail = id.value;
  s.remember(s.now, "removal of the nail of " + name);
  std::erase_if(s.now.nails, [&](const SessionNail& nail) { return nail.id == id; });
  s.stay("", s.last.motion);
  s.record(std::move(gesture));
}

SessionUpdate EditSession::grab(const std::string& body, When at, const Grip& grip, std::vector<Control> also_vary,
                                AlsoVary wanted) {
  state_->requireNoDrag("grab");
  state_->grab(body, at, grip, std::move(also_vary), wanted);
  return last();
}

SessionUpdate EditSession::grabNail(NailId id) {
  state_->requireNoDrag("grabNail");
  state_->grabNail(id);
  return last();
}

SessionUpdate EditSession::dragTo(const Vec3& place, std::stop_token stop) {
  return state_->dragTo(place, std::nullopt, std::move(stop));
}

SessionUpdate EditSession::dragTo(const Vec3& place, const Quat& orientation, std::stop_token stop) {
  return state_->dragTo(place, orientation, std::move(stop));
}

SessionUpdate EditSession::slideTo(const Vec3& place, const std::vector<std::string>& components,
                                   std::stop_token stop) {
  state_->slide(place, components);
  return state_->dragTo(place, std::nullopt, std::move(stop));
}

SessionUpdate EditSession::dwell(std::stop_token stop, const std::function<void(const SessionUpdate&)>& better) {
  return state_->dwell(std::move(stop), better);
}

SessionUpdate EditSession::release(std::stop_token stop) {
  return state_->endDrag(SessionGesture::Ending::release, std::move(stop));
}

SessionUpdate EditSession::releaseNailed(NailAt at, std::stop_token stop) {
  using Ending = SessionGesture::Ending;
  const Ending ending = at == NailAt::target ? Ending::release_nailed : Ending::release_nailed_where_it_got;
  return state_->endDrag(ending, std::move(stop));
}

SessionUpdate EditSession::cancel() { return state_->endDrag(SessionGesture::Ending::cancel, {}); }

bool EditSession::isGrabbed() const { return state_->drag.has_value(); }

namespace {

const SessionDrag& requireDrag(const std::optional<SessionDrag>& drag, const char* call) {
  if (!drag) throw InputError(call, "found no grabbed body, expected grab before it");
  return *drag;
}

}  // namespace

Vec3 EditSession::grabbedPlace() const {
  const SessionGesture& record = requireDrag(state_->drag, "grabbedPlace").record;
  return placeConstrained(motion(), record, "grabbedPlace");
}

Quat EditSession::grabbedOrientation() const {
  const SessionGesture& record = requireDrag(state_->drag, "grabbedOrientation").record;
  return stateAtMoment(motion(), record.body, record.at, "grabbedOrientation").orientation;
}

SessionUpdate EditSession::undo() {
  if (state_->drag) return cancel();
  return state_->goTo(state_->past, state_->future, SessionGesture::Kind::undo);
}

SessionUpdate EditSession::redo() {
  state_->requireNoDrag("redo");
  return state_->goTo(state_->future, state_->past, SessionGesture::Kind::redo);
}

const SessionUpdate& EditSession::last() const { return state_->last; }
double EditSession::duration() const { return state_->now.duration; }
const std::vector<Control>& EditSession::controls() const { return state_->now.controls; }
const SessionOptions& EditSession::options() const { return state_->options; }
const SessionJournal& EditSession::journal() const { return state_->journal; }

std::vector<SessionNumber> EditSession::numbers() const { return sessionNumbers(scene(), controls()); }

std::vector<Constraint> EditSession::constraints() const {
  std::vector<Constraint> all = state_->now.constraints();
  const auto& drag = state_->drag;
  if (drag && !drag->record.grabbed_nail) all.push_back(goalOf(*drag));
  return all;
}

std::vector<NailId> EditSession::nails() const {
  std::vector<NailId> ids;
  for (const SessionNail& nail : state_->now.nails) ids.push_back(nail.id);
  return ids;
}

const Constraint& EditSession::constraintOf(NailId id) const { return state_->nailOf(id).constraint; }

std::vector<NailState> EditSession::nailStates() const {
  std::vector<NailState> states;
  for (const SessionNail& nail : state_->now.nails) states.push_back(state_->stateOf(nail, motion()));
  return states;
}

}  // namespace carom
