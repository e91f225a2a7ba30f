// SPDX-License-Identifier: MIT
// A session that goes on from its history, without solving anything again, and the history of one.
#include <algorithm>
#include <iterator>

#include "adjoint/base/errors.h"
#include "editing/session/session_state.hpp"

namespace carom {

using namespace editing_detail;

namespace {

SessionMoment historyMoment(const SessionHistoryPoint& point) {
  SessionMoment moment;
  moment.scene = moment.reference = std::make_shared<const Scene>(point.scene);
  moment.controls = point.controls;
  for (const auto& [id, constraint, on] : point.nails) moment.nails.push_back({id, constraint, on});
  moment.duration = point.duration;
  moment.step = point.step;
  return moment;
}

SessionHistoryPoint historyPoint(const SessionMoment& moment) {
  SessionHistoryPoint point{*moment.scene, moment.duration, moment.controls, {}, moment.step};
  for (const SessionNail& nail : moment.nails) point.nails.push_back({nail.id, nail.constraint, nail.on});
  return point;
}

template <class To, class From, class Make>
std::vector<To> eachHistory(const std::vector<From>& from, const Make& make) {
  std::vector<To> to;
  std::transform(from.begin(), from.end(), std::back_inserter(to), make);
  return to;
}

}  // namespace

void EditSession::State::resume(const SessionHistory& history) {
  // a change that is measured from the start of the session would be measured from here
  if (options.measure_from == MeasureFrom::start)
    throw InputError("/options/measure_from", "found start, expected grab: a history lacks the changes so far");
  now = historyMoment(history.now);
  const EditProblem checked(*now.scene, contacts, now.duration, now.controls, now.constraints());
  past = eachHistory<SessionMoment>(history.past, historyMoment);
  future = eachHistory<SessionMoment>(history.future, historyMoment);
  next_nail = history.next_nail;
  for (const std::vector<SessionMoment>* moments : {&past, &future})
    for (const SessionMoment& moment : *moments)
      for (const SessionNail& nail : moment.nails) next_nail = std::max(next_nail, nail.id.value + 1);
  for (const SessionNail& nail : now.nails) next_nail = std::max(next_nail, nail.id.value + 1);
  journal = history.journal;
  for (const SessionGesture& gesture : journal.gestures)
    if (gesture.kind == SessionGesture::Kind::keep_sequence)
      options.sequence = gesture.on ? SequencePolicy::stay : SequencePolicy::prefer_start;
  last.motion = simulated(now.scene, now.duration);
  stay("", last.motion);
}

EditSession::EditSession(const SessionHistory& history, ContactSource& contacts)
    : state_(std::make_unique<State>(contacts, history.journal.options)) {
  state_->resume(history);
}

SessionHistory EditSession::history() const {
  const State& s = *state_;
  if (s.drag)
    throw InputError("history", "found '" + s.drag->record.body + "' grabbed, expected release or cancel before it");
  return {eachHistory<SessionHistoryPoint>(s.past, historyPoint), historyPoint(s.now),
          eachHistory<SessionHistoryPoint>(s.future, historyPoint), s.next_nail, s.journal};
}

}  // namespace carom
