// SPDX-License-Identifier: MIT
#include "editing/session_journal.h"

namespace carom {

const char* nameOf(SessionGesture::Kind kind) {
  constexpr const char* kNames[] = {"controls", "nail", "unnail", "drag", "undo", "redo"};
  return kNames[static_cast<int>(kind)];
}

const char* nameOf(SessionGesture::Ending ending) {
  constexpr const char* kNames[] = {"release", "release_nailed", "cancel"};
  return kNames[static_cast<int>(ending)];
}

Constraint heldConstraint(const std::string& body, const When& at, const Held& held) {
  Constraint constraint{body, at, {}};
  const auto three = [&](const char* quantity, const std::optional<Vec3>& v) {
    if (v) constraint.targets.push_back({quantity, {v->x(), v->y(), v->z()}});
  };
  three("position", held.position);
  if (const auto& q = held.orientation) constraint.targets.push_back({"orientation", {q->w(), q->x(), q->y(), q->z()}});
  three("velocity", held.velocity);
  three("angular_velocity", held.angular_velocity);
  if (held.time) constraint.targets.push_back({"time", {*held.time}});
  return constraint;
}

}  // namespace carom
