// SPDX-License-Identifier: MIT
#include "editing/session_journal.h"

#include "adjoint/base/names.hpp"

namespace carom {

using namespace adjoint_detail;

const char* nameOf(SessionGesture::Kind kind) {
  return nameIn({"controls", "nail", "unnail", "drag", "undo", "redo", "set_nail", "nail_on", "meet_nails", "content"}, kind);
}

const char* nameOf(SessionGesture::Ending ending) {
  return nameIn({"release", "release_nailed", "cancel", "release_nailed_where_it_got"}, ending);
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
