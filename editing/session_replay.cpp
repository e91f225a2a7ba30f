// SPDX-License-Identifier: MIT
#include "editing/session_replay.h"

#include <algorithm>
#include <cstring>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/session/session_state.hpp"
#include "editing/session_numbers.h"

namespace carom {
using namespace editing_detail;

namespace {

constexpr std::size_t kFewDifferences = 5;

bool sameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

std::string exactly(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace

SessionReplay::SessionReplay(const SessionJournal& journal, ContactSource& contacts)
    : journal_(journal),
      session_(journal.scene, contacts, journal.duration, journal.controls, journal.nails, journal.options) {
  session_.state_->replays = true;
}

ReplayedGesture SessionReplay::next() {
  if (done()) throw InputError("replay", "found no gesture left, expected one");
  const SessionGesture& gesture = journal_.gestures[next_];
  const std::string where = "/gestures/" + std::to_string(next_);
  ReplayedGesture out;
  try {
    play(gesture, out);
  } catch (const InputError& error) {
    throw InputError(where, error.where().empty() ? error.message() : error.where() + ": " + error.message());
  }
  ++next_;
  out.update = session_.last();
  compare(gesture, out);
  return out;
}

void SessionReplay::play(const SessionGesture& gesture, ReplayedGesture& out) {
  using Kind = SessionGesture::Kind;
  session_.state_->replayed_cut = gesture.cut_after;
  const auto constraint = [&] {
    if (!gesture.constraint) throw InputError("found no constraint, expected that of the nail");
    return *gesture.constraint;
  };
  switch (gesture.kind) {
    case Kind::controls:
      return session_.setControls(gesture.controls);
    case Kind::nail:
      session_.nail(constraint());
      return;
    case Kind::set_nail:
      return session_.setNail({gesture.nail}, constraint());
    case Kind::nail_on:
      return session_.setNailOn({gesture.nail}, gesture.on);
    case Kind::keep_sequence:
      return session_.keepSequence(gesture.on);
    case Kind::meet_nails:
      session_.meetNails();
      return;
    case Kind::unnail:
      return session_.unnail({gesture.nail});
    case Kind::content:
      if (!gesture.content) throw InputError("found no content, expected that of the session");
      return session_.setContent(*gesture.content, gesture.name);
    case Kind::undo:
      session_.undo();
      return;
    case Kind::redo:
      session_.redo();
      return;
    case Kind::drag:
      return playDrag(gesture, out);
  }
}

void SessionReplay::playDrag(const SessionGesture& gesture, ReplayedGesture& out) {
  using Ending = SessionGesture::Ending;
  EditSession::State& state = *session_.state_;
  if (gesture.grabbed_nail) {
    session_.grabNail({*gesture.grabbed_nail});
  } else {
    session_.grab(gesture.body, gesture.at, gesture.grip, gesture.controls);
  }
  for (const DragTarget& target : gesture.targets) {
    state.replayed_cut = target.cut_after;
    const SessionUpdate update = target.dwell         ? session_.dwell()
                                 : target.orientation ? session_.dragTo(target.place, *target.orientation)
                                 : !target.components.empty() ? session_.slideTo(target.place, target.components)
                                                              : session_.dragTo(target.place);
    ++out.updates;
    out.slowest_milliseconds = std::max(out.slowest_milliseconds, update.milliseconds);
  }
  state.replayed_cut = gesture.cut_after;
  switch (gesture.ending) {
    case Ending::release:
      session_.release();
      return;
    case Ending::release_nailed:
      session_.releaseNailed();
      return;
    case Ending::release_nailed_where_it_got:
      session_.releaseNailed(NailAt::where_it_got);
      return;
    case Ending::cancel:
      session_.cancel();
  }
}

void SessionReplay::compare(const SessionGesture& gesture, ReplayedGesture& out) const {
  const auto differ = [&](const std::string& name, const std::string& found, const std::string& recorded) {
    if (out.differences.size() < kFewDifferences)
      out.differences.push_back(name + ": found " + found + ", the journal has " + recorded);
  };
  const std::vector<SessionNumber> numbers = sessionNumbers(session_.scene(), session_.controls());
  if (numbers.size() != gesture.numbers.size()) {
    differ("numbers", std::to_string(numbers.size()), std::to_string(gesture.numbers.size()));
    return;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!sameBits(numbers[i].value, gesture.numbers[i]))
      differ(numbers[i].name, exactly(numbers[i].value), exactly(gesture.numbers[i]));
  if (out.update.reached != gesture.reached)
    differ("reached", out.update.reached ? "true" : "false", gesture.reached ? "true" : "false");
  if (!sameBits(out.update.distance, gesture.distance))
    differ("distance", exactly(out.update.distance), exactly(gesture.distance));
}

}  // namespace carom
