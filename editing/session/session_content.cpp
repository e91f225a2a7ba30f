// SPDX-License-Identifier: MIT
// All that a session is about, put in place of what there was.
#include <algorithm>

#include "adjoint/base/errors.h"
#include "editing/detail/messages.hpp"
#include "editing/session/session_state.hpp"

namespace carom {
using namespace editing_detail;

SessionMoment EditSession::State::momentOf(const SessionContent& content, int& next_free_nail) {
  std::vector<Constraint> constraints;
  for (const auto& [id, constraint] : content.nails) constraints.push_back(constraint);
  const EditProblem checked(content.scene, contacts, content.duration, content.controls, constraints);
  SessionMoment moment;
  moment.scene = moment.reference = std::make_shared<const Scene>(content.scene);
  moment.duration = content.duration;
  moment.controls = content.controls;
  for (const auto& [id, constraint] : content.nails) {
    const bool is_new = id == NailId();
    const NailId own = is_new ? NailId{next_free_nail++} : id;
    if (moment.find(own)) throw InputError("content", "found nail " + std::to_string(id.value) + " twice, expected once");
    moment.nails.push_back({own, constraint, is_new || nailOf(id).on});
  }
  return moment;
}

void EditSession::setContent(const SessionContent& content, const std::string& name) {
  State& s = *state_;
  s.requireNoDrag("setContent");
  SessionGesture gesture = s.newGesture(SessionGesture::Kind::content);
  gesture.content = content, gesture.name = name;
  int next_nail = s.next_nail;
  SessionMoment moment = s.momentOf(content, next_nail);
  std::shared_ptr<const Motion> motion = s.simulated(moment.scene, moment.duration);
  const std::shared_ptr<const Motion> shown = s.last.motion;
  s.next_nail = next_nail;
  s.remember(std::move(s.now), name.empty() ? "other content" : name);
  s.now = std::move(moment);
  s.last.motion = std::move(motion);
  s.stay("", shown);
  s.record(std::move(gesture));
}

SessionContent EditSession::content() const {
  const SessionMoment& now = state_->now;
  SessionContent content{*now.scene, now.duration, now.controls, {}};
  for (const SessionNail& nail : now.nails) content.nails.push_back({nail.id, nail.constraint});
  return content;
}

}  // namespace carom
