// SPDX-License-Identifier: MIT
// Steps back and forward, and the journal.
#include <algorithm>

#include "editing/detail/messages.hpp"
#include "editing/session/session_state.hpp"
#include "editing/session/session_words.hpp"
#include "editing/session_numbers.h"

namespace carom {

using namespace editing_detail;

std::vector<Constraint> editing_detail::SessionMoment::constraints() const {
  std::vector<Constraint> all;
  for (const SessionNail& nail : nails) all.push_back(nail.constraint);
  return all;
}

void editing_detail::SessionMoment::setControls(std::vector<Control> others) {
  controls = std::move(others);
  reference = scene;
  changes.resize(0);
}

SessionNail* editing_detail::SessionMoment::find(NailId id) {
  const auto found = std::find_if(nails.begin(), nails.end(), [&](const SessionNail& nail) { return nail.id == id; });
  return found == nails.end() ? nullptr : &*found;
}

void EditSession::State::remember(SessionMoment before, std::string step) {
  before.step = std::move(step);
  past.push_back(std::move(before));
  future.clear();
}

void EditSession::State::record(SessionGesture gesture) {
  gesture.reached = last.reached;
  gesture.distance = last.distance;
  for (const SessionNumber& number : sessionNumbers(*now.scene, now.controls)) gesture.numbers.push_back(number.value);
  journal.gestures.push_back(std::move(gesture));
}

SessionUpdate EditSession::State::stay(const std::string& message, const std::shared_ptr<const Motion>& shown) {
  const auto began_at = Clock::now();
  SessionUpdate update;
  update.motion = last.motion;
  update.moved = update.motion != shown;
  update.message = message.empty() ? earlyEnd(*update.motion) : message;
  const std::string left_out = constrainedNails(now.nails).left_out;
  if (!left_out.empty()) update.message += (update.message.empty() ? "" : " ") + left_out;
  measureNails(update);
  update.milliseconds = millisecondsSince(began_at);
  return last = std::move(update);
}

SessionUpdate EditSession::State::goTo(std::vector<SessionMoment>& from, std::vector<SessionMoment>& to,
                                       SessionGesture::Kind kind) {
  const bool back = kind == SessionGesture::Kind::undo;
  const std::shared_ptr<const Motion> shown = last.motion;
  if (from.empty()) return stay(back ? "There is nothing to undo." : "There is nothing to redo.", shown);
  SessionGesture gesture = newGesture(kind);
  const SessionMoment& there = from.back();
  if (there.scene != now.scene || there.duration != now.duration)
    last.motion = simulated(there.scene, there.duration);
  now.step = there.step;
  to.push_back(std::move(now));
  now = std::move(from.back());
  from.pop_back();
  stay("", shown);
  record(std::move(gesture));
  return last;
}

bool EditSession::canUndo() const { return state_->drag || !state_->past.empty(); }
std::size_t EditSession::undoDepth() const { return state_->past.size(); }
bool EditSession::canRedo() const { return !state_->drag && !state_->future.empty(); }

std::string EditSession::undoName() const {
  const State& s = *state_;
  if (s.drag) return stepName(*s.drag);
  return s.past.empty() ? "" : s.past.back().step;
}

std::string EditSession::redoName() const {
  const State& s = *state_;
  return s.drag || s.future.empty() ? "" : s.future.back().step;
}

}  // namespace carom
