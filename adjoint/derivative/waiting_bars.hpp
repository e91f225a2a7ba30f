// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "adjoint/derivative/derivative_tape.h"

namespace carom::adjoint_detail {

/// The adjoints of a reverse pass in numbers S, on their way back through a motion: those that wait at events, the
/// latest of which comes first, and what they come to in the end.
template <class S>
class WaitingBars {
 public:
  using StateBar = StateDerivativeOf<S>;
  // At an event, by participant.
  struct AtEvent {
    std::vector<StateBar> after, before;
    S time = 0;
  };

  explicit WaitingBars(const Motion& motion)
      : scene(*motion.scene),
        start(motion.world_lines.size()),
        model(motion.world_lines.size()),
        motion_(motion),
        slot_of_(motion.events.size(), -1) {}

  SceneDerivativeOf<S> scene;
  // a body each: of the start, and of the mass properties
  std::vector<StateBar> start;
  std::vector<BodyModelDerivativeOf<S>> model;

  /// What is read of a body at an event, whose weight of time is `time`; `rateOf()`: how fast its state changes there.
  /// False where the body has no part in the event, or stays: then `bar` is still to go through its arc.
  template <class Rate>
  bool readAtEvent(const Instant& instant, int body, const StateBar& bar, const S& time, const Rate& rateOf) {
    const int event = instant.event;
    AtEvent& at = atEvent(event);
    at.time += time;
    const Participant* p = eventOf(event).find(body);
    if (p && !instant.follows) {
      at.before[placeOf(event, *p)] += bar;
      return true;
    }
    at.time += bar.dot(rateOf());  // it moves on while the event comes later
    if (!p || p->stays) return false;
    at.after[placeOf(event, *p)] += bar;
    return true;
  }
  /// Of a body at the start of its arc k, which is an event or the start of the motion.
  void arriveAt(int body, int k, const StateBar& bar) {
    const auto b = static_cast<std::size_t>(body);
    if (k == 0) {
      start[b] += bar;
      return;
    }
    const int event = motion_.world_lines[b].events[static_cast<std::size_t>(k) - 1];
    atEvent(event).after[placeOf(event, *eventOf(event).find(body))] += bar;
  }
  /// Calls through(event, bars) from the latest event on; it adds to earlier ones.
  template <class Through>
  void eachEvent(const Through& through) {
    while (!pending_.empty()) {
      std::ranges::pop_heap(pending_);
      const int event = pending_.back(), slot = slot_of_[static_cast<std::size_t>(event)];
      pending_.pop_back();
      AtEvent bars = std::move(slots_[static_cast<std::size_t>(slot)]);
      through(event, std::as_const(bars));
      slots_[static_cast<std::size_t>(slot)] = std::move(bars);
      free_.push_back(slot);
    }
  }

 private:
  const Event& eventOf(int event) const { return motion_.events[static_cast<std::size_t>(event)]; }
  std::size_t placeOf(int event, const Participant& p) const {
    return static_cast<std::size_t>(&p - eventOf(event).participants.data());
  }
  AtEvent& atEvent(int event) {
    int& slot = slot_of_[static_cast<std::size_t>(event)];
    if (slot >= 0) return slots_[static_cast<std::size_t>(slot)];
    if (free_.empty()) {
      slot = static_cast<int>(slots_.size());
      slots_.emplace_back();
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    pending_.push_back(event);
    std::ranges::push_heap(pending_);
    AtEvent& at = slots_[static_cast<std::size_t>(slot)];
    at.after.assign(eventOf(event).participants.size(), {});
    at.before.assign(eventOf(event).participants.size(), {});
    at.time = 0;
    return at;
  }

  const Motion& motion_;
  std::vector<int> pending_;     // a heap of events, the latest first
  std::vector<int> slot_of_;     // of each event; -1: nothing has arrived
  std::vector<AtEvent> slots_;   // which keep their memory for events to come
  std::vector<int> free_;        // slots whose event is through
};

}  // namespace carom::adjoint_detail
