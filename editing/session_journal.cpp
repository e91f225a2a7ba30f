// SPDX-License-Identifier: MIT
#include "editing/session_journal.h"

#include "editing/problem/controls/control_binding.hpp"
#include "editing/session/session_state.hpp"

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

std::vector<SessionNumber> sessionNumbers(const Scene& scene, const std::vector<Control>& controls) {
  std::vector<SessionNumber> numbers;
  Scene prepared = scene;
  for (const Control& control : controls) {
    const BoundControl bound = bindControl(prepared, control, "");
    const std::string name = describe(control);
    if (control.vary == "orientation") {  // as a control it is a turn from where it was; here it is where it is
      const Quat& q = prepared.bodies[static_cast<std::size_t>(bound.owner.body)].orientation;
      const double parts[] = {q.w(), q.x(), q.y(), q.z()};
      for (int k = 0; k < 4; ++k) numbers.push_back({name + ", " + std::string(1, "wxyz"[k]), parts[k]});
      continue;
    }
    const std::vector<std::string> components = bound.kind->components(prepared, bound.owner);
    const Eigen::VectorXd values = bound.kind->get(prepared, bound.owner);
    for (std::size_t k = 0; k < components.size(); ++k)
      numbers.push_back(
          {components.size() > 1 ? name + ", " + components[k] : name, values[static_cast<Eigen::Index>(k)]});
  }
  return numbers;
}

void EditSession::State::record(SessionGesture gesture) {
  gesture.reached = last.reached;
  gesture.distance = last.distance;
  for (const SessionNumber& number : sessionNumbers(*now.scene, now.controls)) gesture.numbers.push_back(number.value);
  journal.gestures.push_back(std::move(gesture));
}

}  // namespace carom
