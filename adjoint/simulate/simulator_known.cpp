// SPDX-License-Identifier: MIT
#include "adjoint/simulate/simulator.hpp"

// Bodies whose paths are taken over from a motion of nearly the same scene.

namespace carom::adjoint_detail {

Arc Simulator::takenArcOf(int body) const { return known_.arcOf(body).withModel((*motion_.models)[index(body)]); }

// The next event of known bodies becomes the draft.
void Simulator::takeOver() {
  draft_.event = known_.next();
  draft_.beyond.clear();
  draft_.arcs.clear();
  draft_.onward.clear();
  bodies_.clear();
  known_.pass();
  for (const Participant& p : draft_.event.participants) {
    in_draft_[index(p.body)] = static_cast<int>(bodies_.size());
    bodies_.push_back(p.body);
    draft_.arcs.push_back(takenArcOf(p.body));
  }
  predictDraft();
}

// Whether an event that `body` takes part in, -1: nobody, is about to part it from what is known of it.
bool Simulator::meetsKnown(int body) {
  if (known_.has(body)) met_known_ = body;
  return met_known_.has_value();
}

}  // namespace carom::adjoint_detail
