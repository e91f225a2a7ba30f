// SPDX-License-Identifier: MIT
#include "editing/session_update.h"

#include <string>

#include "python/src/session.hpp"

namespace carom::python {
namespace {

template <class Value>
void bindOf(nb::class_<PyUpdate>& update, const char* name, Value SessionUpdate::* member, const char* text) {
  update.def_prop_ro(name, [member](const PyUpdate& self) { return self.update.*member; }, nb::rv_policy::copy, text);
}

const PyMotion& motionOfUpdate(PyUpdate& self) {
  if (!self.motion) self.motion = motionOf(sceneWith(self.original, self.update.scene()), self.update.motion);
  return *self.motion;
}

std::string reprOfUpdate(const PyUpdate& self) {
  const SessionUpdate& update = self.update;
  std::string text = std::string("<SessionUpdate ") + nameOf(update.stage) + (update.reached ? ", reached" : ", not reached");
  if (update.distance != 0) text += ", " + numberText(update.distance) + " m away";
  return text + (update.message.empty() ? "" : ": " + update.message) + ">";
}

void bindErrors(nb::class_<PyUpdate>& update) {
  bindOf(update, "reached", &SessionUpdate::reached, "Target and enforced nails are met within the tolerance.");
  bindOf(update, "distance", &SessionUpdate::distance, "m, from the grabbed point to its target; 0 without a target.");
  bindOf(update, "turn", &SessionUpdate::turn, "rad, from the orientation to its target; 0 without a target.");
  bindOf(update, "scaled_distance", &SessionUpdate::scaled_distance, "Largest error of a row of the grab, dimensionless.");
  bindOf(update, "nail_error", &SessionUpdate::nail_error, "Largest error of a row of a nail, SI, mixed units.");
  bindOf(update, "scaled_nail_error", &SessionUpdate::scaled_nail_error, "The same, dimensionless.");
}

}  // namespace

void bindSessionUpdates(nb::module_& module) {
  nb::class_<PyUpdate> update(module, "SessionUpdate", "State of a session after a call, and its distance from the targets.");
  bindErrors(update);
  bindOf(update, "iterations", &SessionUpdate::iterations, "Steps taken.");
  bindOf(update, "simulations", &SessionUpdate::simulations, "The unit in which work is limited.");
  bindOf(update, "milliseconds", &SessionUpdate::milliseconds, "Wall time.");
  bindOf(update, "cut_by_clock", &SessionUpdate::cut_by_clock, "Timed out: a faster machine may get further.");
  bindOf(update, "stopped", &SessionUpdate::stopped, "It was stopped.");
  bindOf(update, "moved", &SessionUpdate::moved, "The motion differs from the one before the call.");
  bindOf(update, "sequence_changed", &SessionUpdate::sequence_changed,
         "Reported impacts differ from those at the start of the gesture.");
  bindOf(update, "sequence_changes", &SessionUpdate::sequence_changes, "The differences.");
  bindOf(update, "message", &SessionUpdate::message, "What happened, in sentences.");
  update.def_prop_ro("motion", &motionOfUpdate, nb::rv_policy::copy, "Of the whole duration of the session.")
      .def_prop_ro("stage", [](const PyUpdate& self) { return nameOf(self.update.stage); },
                   "'kept', 'predicted', 'improved' or 'solved'.")
      .def_prop_ro("obstacle", [](const PyUpdate& self) { return nameOf(self.update.obstacle.kind); },
                   "What prevents reaching the target: 'none', 'no_control_moves_it', 'nails', 'bounds', 'border' (a boundary "
                   "of the impact sequence), 'work' or 'clock'.")
      .def_prop_ro("at_bounds", [](const PyUpdate& self) { return self.update.obstacle.at_bounds; }, nb::rv_policy::copy,
                   "Names of the parameters at active bounds.")
      .def("__repr__", &reprOfUpdate);
}

}  // namespace carom::python
