// SPDX-License-Identifier: MIT
#include "adjoint/simulate/simulator.hpp"

// Bodies whose paths are taken over from a motion of nearly the same scene.

namespace carom::adjoint_detail {

// Bodies that share a trajectory go on sharing it.
Arc Simulator::takenArcOf(int body) {
  const Arc& known = reused_.arcOf(body);
  if (!known.trajectory().group()) return known.fork();
  auto& taken = taken_groups_[known.shared().get()];
  if (!taken) taken = known.trajectory().fork();
  return known.on(taken);
}

// The next event of known bodies becomes the draft.
void Simulator::takeOver() {
  draft_.event = reused_.next();
  draft_.beyond.clear();
  draft_.arcs.clear();
  draft_.contact_state.clear();
  bodies_.clear();
  reused_.pass();
  for (const Participant& p : draft_.event.participants) {
    in_draft_[index(p.body)] = static_cast<int>(bodies_.size());
    bodies_.push_back(p.body);
    draft_.arcs.push_back(takenArcOf(p.body));
  }
  predictDraft();
}

// Whether an event that `body` takes part in, -1: nobody, is about to part it from what is known of it.
bool Simulator::invalidatesReuse(int body) {
  if (reused_.has(body)) reuse_invalidated_by_ = body;
  return reuse_invalidated_by_.has_value();
}

}  // namespace carom::adjoint_detail
