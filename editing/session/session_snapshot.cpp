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
  const std::optional<AskedFor>& asked = s.now.asked;
  snapshot.began = asked ? *asked->began : scene();
  snapshot.content = content();
  snapshot.reached = s.last.reached;
  snapshot.tolerance = s.options.tolerance;
  snapshot.sequence = s.options.sequence;
  const auto want = [&](const Constraint& constraint, NailId id) {
    snapshot.wanted.push_back(constraint);
    snapshot.nails.push_back(id);
  };
  bool has_goal = asked && asked->goal && asked->nail == NailId();
  for (const SessionNail& nail : s.now.nails) {
    if (asked && asked->goal && nail.id == asked->nail) {
      has_goal = nail.on;
      continue;
    }
    if (nail.on && s.stateOf(nail, motion()).available) want(nail.constraint, nail.id);
  }
  if (has_goal) want(*asked->goal, asked->nail);
  return snapshot;
}

}  // namespace carom
