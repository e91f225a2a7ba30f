// SPDX-License-Identifier: MIT
// What a gesture asked for, for those who look further in other threads.
#include "editing/session_snapshot.h"

#include "editing/session/session_state.hpp"

namespace carom {
using namespace editing_detail;

Constraint EditSession::State::askedBy(const SessionDrag& ended) {
  const SessionGesture& gesture = ended.record;
  if (!gesture.grabbed_nail) return goalOf(ended);
  Constraint goal = nailOf({*gesture.grabbed_nail}).constraint;
  putNail(goal, ended.place, ended.orientation);
  if (gesture.grip.contact)
    for (Target& target : goal.targets)
      if (target.quantity == "contact") recentre(target, ended.place);
  return goal;
}

SessionSnapshot EditSession::snapshot() const {
  const State& s = *state_;
  s.requireNoDrag("snapshot");
  SessionSnapshot snapshot;
  snapshot.began = s.asked ? *s.asked->began : scene();
  snapshot.content = content();
  snapshot.reached = s.last.reached;
  snapshot.tolerance = s.options.tolerance;
  snapshot.sequence = s.options.sequence;
  const auto want = [&](const Constraint& constraint, NailId id) {
    snapshot.wanted.push_back(constraint);
    snapshot.nails.push_back(id);
  };
  const bool has_goal = s.asked && s.asked->goal;
  for (const SessionNail& nail : s.now.nails) {
    if (has_goal && nail.id == s.asked->nail) continue;
    if (nail.on && s.stateOf(nail, motion()).available) want(nail.constraint, nail.id);
  }
  if (has_goal) want(*s.asked->goal, s.asked->nail);
  return snapshot;
}

}  // namespace carom
