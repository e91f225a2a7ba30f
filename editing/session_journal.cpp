// SPDX-License-Identifier: MIT
#include "editing/session_journal.h"

#include "adjoint/base/names.hpp"

namespace carom {

using namespace adjoint_detail;

const char* nameOf(SessionGesture::Kind kind) {
  return nameIn({"controls", "nail", "unnail", "drag", "undo", "redo", "set_nail", "nail_on", "meet_nails", "content", "keep_sequence"},
                kind);
}

const char* nameOf(SessionGesture::Ending ending) {
  return nameIn({"release", "release_nailed", "cancel", "release_nailed_where_it_got"}, ending);
}

Constraint nailConstraint(const std::string& body, const When& at, const NailTargets& targets) {
  Constraint constraint{body, at, {}};
  const auto three = [&](const char* quantity, const std::optional<WantedVector>& v) {
    if (v) constraint.targets.push_back(targetOf(quantity, *v));
  };
  three("position", targets.position);
  if (const auto& q = targets.orientation)
    constraint.targets.push_back({"orientation", {q->w(), q->x(), q->y(), q->z()}});
  three("velocity", targets.velocity);
  three("angular_velocity", targets.angular_velocity);
  if (targets.time) constraint.targets.push_back({"time", {double(*targets.time)}});
  return constraint;
}

}  // namespace carom
