// SPDX-License-Identifier: MIT
#include "adjoint/base/errors.h"
#include "python/src/arrays.hpp"
#include "python/src/session.hpp"

namespace carom::python {
namespace {

using Target3 = std::optional<ArrayLike>;

std::optional<Vec3> givenVector(const Target3& given, const char* where) {
  return given ? std::optional(vectorOf(*given, where)) : std::nullopt;
}

Constraint constraintOf(const std::string& body, const WhenArgument& at, const Target3& position,
                        const Target3& orientation, const Target3& velocity, const Target3& angular_velocity,
                        std::optional<double> time) {
  NailTargets targets;
  targets.position = givenVector(position, "position");
  if (orientation) targets.orientation = quaternionOf(*orientation, "orientation");
  targets.velocity = givenVector(velocity, "velocity");
  targets.angular_velocity = givenVector(angular_velocity, "angular_velocity");
  targets.time = time;
  return nailConstraint(body, whenOf(at), targets);
}

int sessionNail(const PySession& self, const std::string& body, const WhenArgument& at, const Target3& position,
                const Target3& orientation, const Target3& velocity, const Target3& angular_velocity,
                std::optional<double> time) {
  const Constraint constraint = constraintOf(body, at, position, orientation, velocity, angular_velocity, time);
  NailId id;
  callLong(self, [&](EditSession& session, std::stop_source& stop) { id = session.nail(constraint, stop.get_token()); });
  return id.value;
}

void setNail(const PySession& self, int id, const std::string& body, const WhenArgument& at, const Target3& position,
             const Target3& orientation, const Target3& velocity, const Target3& angular_velocity,
             std::optional<double> time) {
  const Constraint constraint = constraintOf(body, at, position, orientation, velocity, angular_velocity, time);
  callLong(self, [&](EditSession& session, std::stop_source& stop) {
    session.setNail(NailId{id}, constraint, stop.get_token());
  });
}

int nailedAsItIs(const PySession& self, const std::string& body, const WhenArgument& at) {
  NailId id;
  callLong(self, [&](EditSession& session, std::stop_source&) { id = session.nailAsItIs(body, whenOf(at)); });
  return id.value;
}

PyUpdate metNails(const PySession& self) {
  std::optional<SessionUpdate> update;
  callLong(self, [&](EditSession& session, std::stop_source& stop) { update = session.meetNails(stop.get_token()); });
  return {self.content->scene, std::move(*update)};
}

std::string reprOfState(const NailState& state) {
  return "<NailState " + std::to_string(state.id.value) + (state.on ? "" : ", off") + (state.met ? ", met" : ", not met") +
         (state.message.empty() ? "" : ": " + state.message) + ">";
}

void bindNailStates(nb::module_& module) {
  nb::class_<NailState>(module, "NailState", "State of a nail of a session in the current motion.")
      .def_prop_ro("id", [](const NailState& self) { return self.id.value; }, "Which.")
      .def_ro("on", &NailState::on, "Enforced by gestures.")
      .def_ro("soft", &NailState::soft, "Gives way to the others, and to what is dragged.")
      .def_ro("available", &NailState::available, "Can be evaluated: its impact or rest happens.")
      .def_ro("met", &NailState::met, "Within the tolerance.")
      .def_ro("time", &NailState::time, "s, its current time; NaN if not available.")
      .def_ro("error", &NailState::error, "Largest error of its rows, SI; NaN if not available.")
      .def_ro("scaled_error", &NailState::scaled_error, "The same, dimensionless.")
      .def_ro("message", &NailState::message, "Why it is not met, or not available; empty if met.")
      .def("__repr__", &reprOfState);
}

}  // namespace

void bindSessionNails(nb::module_& module, nb::class_<PySession>& session) {
  bindNailStates(module);
  const auto none = nb::none();
  session
      .def("nail", &sessionNail, nb::arg("body"), nb::arg("at"), nb::kw_only(), nb::arg("position") = none,
           nb::arg("orientation") = none, nb::arg("velocity") = none, nb::arg("angular_velocity") = none,
           nb::arg("time") = none,
           "Adds a nail, enforced until it is removed, and solves for it; `last` has the outcome. Gives its id. One undo "
           "step.")
      .def("nail_as_it_is", &nailedAsItIs, nb::arg("body"), nb::arg("at"),
           "Nails the body as it is at that moment: position and orientation. Gives its id.")
      .def("set_nail", &setNail, nb::arg("id"), nb::arg("body"), nb::arg("at"), nb::kw_only(), nb::arg("position") = none,
           nb::arg("orientation") = none, nb::arg("velocity") = none, nb::arg("angular_velocity") = none,
           nb::arg("time") = none,
           "Replaces what a nail holds, arguments as in `nail`, and solves for it if it is on. One undo step.")
      .def("set_nail_on",
           [](const PySession& self, int id, bool on) {
             readFrom(self, [&](EditSession& of) { of.setNailOn(NailId{id}, on); });
           },
           nb::arg("id"), nb::arg("on"), "A nail that is off is kept, but not enforced. One undo step.")
      .def("meet_nails", &metNails, "Switches all nails on and solves for those that are available. One undo step.")
      .def("unnail",
           [](const PySession& self, int id) {
             readFrom(self, [&](EditSession& of) { of.unnail(NailId{id}); });
           },
           nb::arg("id"), "Removes a nail. The motion does not change. One undo step.")
      .def_prop_ro("nails",
                   [](const PySession& self) { return readFrom(self, [](EditSession& of) { return of.nailStates(); }); },
                   nb::rv_policy::move, "All nails, oldest first, in the current motion.");
}

}  // namespace carom::python
