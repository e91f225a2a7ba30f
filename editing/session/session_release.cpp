// SPDX-License-Identifier: MIT
// The end of a drag: what is kept, and where nails stay.
#include "adjoint/base/errors.h"
#include "editing/session/session_state.hpp"

namespace carom {
using namespace editing_detail;

SessionUpdate EditSession::State::cancelDrag() {
  const auto began_at = Clock::now();
  SessionDrag ended = std::move(*drag);
  drag.reset();
  now = std::move(ended.began);
  const std::shared_ptr<const Motion> shown = last.motion;
  last.motion = ended.before;
  stay("", shown);
  last.milliseconds = millisecondsSince(began_at);
  record(std::move(ended.record));
  return last;
}

SessionUpdate EditSession::State::finishDrag(std::stop_token stop) {
  Budget budget = this->budget(options.release_iterations, options.release_seconds, std::move(stop));
  SessionSolver& solver = *drag->solver;
  const EditPointPtr from = solver.point();
  const int steps = solver.iterations();
  if (!drag->record.targets.empty()) solver.finish(budget);
  SessionUpdate update;
  update.motion = solver.point() == from ? last.motion : solver.atStart() ? drag->before : motionOf(solver);
  update.moved = update.motion != last.motion;
  update.stage = solver.atStart() ? SessionStage::kept : SessionStage::solved;
  update.iterations = solver.iterations() - steps;
  putEnd(budget, update);
  drag->record.cut_after = budget.cutAfter();
  measureGoal(solver, update);
  measureDrag(update);
  describe(solver, *drag->before, drag->left_out, update);
  return update;
}

void EditSession::State::leaveNail(SessionDrag& ended, const SessionUpdate& update) {
  using Ending = SessionGesture::Ending;
  const SessionGesture& record = ended.record;
  const bool at_target = record.ending == Ending::release_nailed || update.scaled_distance <= options.tolerance;
  if (!at_target) {
    const BodyState state = stateAtMoment(*update.motion, record.body, record.at, "release");
    ended.place = placeConstrained(*update.motion, record, "release");
    if (ended.orientation) ended.orientation = state.orientation;
  }
  if (record.grabbed_nail) {
    Constraint& nail = nailOf({*record.grabbed_nail}).constraint;
    if (!record.targets.empty()) putNail(nail, ended.place, ended.orientation);
    if (!record.targets.empty() && record.grip.contact)
      for (Target& target : nail.targets)
        if (target.quantity == "contact") recentre(target, placeConstrained(*update.motion, record, "release"));
  } else if (record.ending != Ending::release) {
    ended.record.nail = next_nail;
    now.nails.push_back({{next_nail++}, goalOf(ended)});
  }
}

SessionUpdate EditSession::State::endDrag(SessionGesture::Ending ending, std::stop_token stop) {
  const auto began_at = Clock::now();
  const char* const kCalls[] = {"release", "releaseNailed", "cancel", "releaseNailed"};
  if (!drag) throw InputError(kCalls[static_cast<int>(ending)], "found no grabbed body, expected grab before it");
  drag->record.ending = ending;
  if (ending == SessionGesture::Ending::cancel) return cancelDrag();
  SessionUpdate update = finishDrag(std::move(stop));
  SessionDrag ended = std::move(*drag);
  drag.reset();
  takeOver(*ended.solver, update);
  std::optional<AskedFor> wanted;
  if (!ended.record.targets.empty()) wanted = AskedFor{ended.began.scene, askedBy(ended), NailId()};
  leaveNail(ended, update);
  const bool moved_nail = ended.record.grabbed_nail && !ended.record.targets.empty();
  const bool new_nail = ended.record.nail >= 0, varies = !ended.record.controls.empty();
  if (moved_nail || new_nail || varies || !ended.solver->atStart()) remember(std::move(ended.began), stepName(ended));
  last = std::move(update);
  last.milliseconds = millisecondsSince(began_at);
  if (wanted) wanted->nail = ended.record.grabbed_nail ? NailId{*ended.record.grabbed_nail} : NailId{ended.record.nail};
  if (wanted) now.asked = std::move(wanted);
  record(std::move(ended.record));
  return last;
}

}  // namespace carom
