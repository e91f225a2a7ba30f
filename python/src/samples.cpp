// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/base/errors.h"
#include "python/src/arrays.hpp"
#include "python/src/motion.hpp"

namespace carom::python {
namespace {

/// carom.BodyState.
struct PyState {
  explicit PyState(const BodyState& of) : state(of), orientation(wxyz(of.orientation)) {}
  BodyState state;
  Eigen::Vector4d orientation;
};

/// carom.States: what is sampled, in arrays of its own.
struct PyStates {
  nb::object times, position, orientation, velocity, angular_velocity;
};

/// The numbers of states, one quantity after the other, each in C order.
struct SampledNumbers {
  explicit SampledNumbers(std::size_t count)
      : position(3 * count), orientation(4 * count), velocity(3 * count), angular_velocity(3 * count) {}
  void put(std::size_t k, const BodyState& state) {
    copy(state.position, &position[3 * k]);
    copy(wxyz(state.orientation), &orientation[4 * k]);
    copy(state.velocity, &velocity[3 * k]);
    copy(state.angular_velocity, &angular_velocity[3 * k]);
  }
  template <class Vector>
  static void copy(const Vector& from, double* to) {
    std::copy(from.data(), from.data() + from.size(), to);
  }
  std::vector<double> position, orientation, velocity, angular_velocity;
};

using SampledBodies = std::variant<BodyName, std::vector<BodyName>>;

std::vector<int> bodiesOf(const Scene& scene, const SampledBodies& bodies) {
  if (const auto* one = std::get_if<BodyName>(&bodies)) return {bodyOf(scene, *one)};
  std::vector<int> all;
  for (const BodyName& body : std::get<std::vector<BodyName>>(bodies)) all.push_back(bodyOf(scene, body));
  return all;
}

SampledNumbers sampledNumbers(const Motion& motion, const std::vector<int>& bodies, const std::vector<double>& times) {
  SampledNumbers numbers(bodies.size() * times.size());
  std::size_t k = 0;
  for (const int body : bodies)
    for (const double time : times) numbers.put(k++, motion.stateAt(body, time));
  return numbers;
}

PyStates sampled(const PyMotion& self, const SampledBodies& bodies, const ArrayLike& times) {
  const auto given = numbersOf(times, "times", {-1});
  std::vector<double> at(given.data(), given.data() + given.size());
  const std::vector<int> indices = bodiesOf(self.scene.scene(), bodies);
  SampledNumbers numbers = [&] {
    const Computing free;
    return sampledNumbers(self.motion(), indices, at);
  }();
  const std::size_t rows = indices.size(), columns = at.size();
  const auto array = [&](std::vector<double>& values, std::size_t size) -> nb::object {
    if (std::holds_alternative<BodyName>(bodies)) return owning<Array<-1, -1>>(std::move(values), {columns, size}).cast();
    return owning<Array<-1, -1, -1>>(std::move(values), {rows, columns, size}).cast();
  };
  return {owning<Array<-1>>(std::move(at), {columns}).cast(), array(numbers.position, 3),
          array(numbers.orientation, 4), array(numbers.velocity, 3), array(numbers.angular_velocity, 3)};
}

std::string arrayShape(const nb::object& array) { return pythonText(array.attr("shape")); }

constexpr const char* kSampleText =
    "States of bodies at times from 0 to `end`, in any order. For a list of B names and T times, float64: position "
    "(B, T, 3), orientation (B, T, 4), velocity and angular_velocity (B, T, 3); for a single body without the first "
    "axis. At the time of an impact, the state after it. Raises InputError for an unknown body and a time outside.";

void bindState(nb::module_& module) {
  nb::class_<PyState>(module, "BodyState", "State of a body, world axes.")
      .def_prop_ro("position", [](const PyState& self) { return view(self.state.position); }, "m, of the shape's origin")
      .def_prop_ro("orientation", [](const PyState& self) { return view(self.orientation); },
                   "Unit quaternion w, x, y, z, shape to world.")
      .def_prop_ro("velocity", [](const PyState& self) { return view(self.state.velocity); },
                   "m/s, of the centre of mass")
      .def_prop_ro("angular_velocity", [](const PyState& self) { return view(self.state.angular_velocity); }, "rad/s")
      .def("__repr__", [](const nb::handle& self) {
        std::string text = "<BodyState";
        for (const char* name : {"position", "orientation", "velocity", "angular_velocity"})
          text += std::string(" ") + name + "=" + pythonText(self.attr(name).attr("tolist")());
        return text + ">";
      });
}

void bindStates(nb::module_& module) {
  constexpr const char* type = "(self, /) -> numpy.typing.NDArray[numpy.float64]";
  const std::string heads[] = {std::string("def times") + type, std::string("def position") + type,
                               std::string("def orientation") + type, std::string("def velocity") + type,
                               std::string("def angular_velocity") + type};
  nb::class_<PyStates>(module, "States", "Sampled states of one or several bodies, see Motion.sample.")
      .def_prop_ro("times", [](const PyStates& self) { return self.times; }, nb::sig(heads[0].c_str()), "s")
      .def_prop_ro("position", [](const PyStates& self) { return self.position; }, nb::sig(heads[1].c_str()), "m")
      .def_prop_ro("orientation", [](const PyStates& self) { return self.orientation; }, nb::sig(heads[2].c_str()),
                   "Unit quaternions w, x, y, z.")
      .def_prop_ro("velocity", [](const PyStates& self) { return self.velocity; }, nb::sig(heads[3].c_str()), "m/s")
      .def_prop_ro("angular_velocity", [](const PyStates& self) { return self.angular_velocity; },
                   nb::sig(heads[4].c_str()), "rad/s")
      .def("__repr__", [](const PyStates& self) { return "<States of shape " + arrayShape(self.position) + ">"; });
}

}  // namespace

void bindSamples(nb::module_& module, nb::class_<PyMotion>& motion) {
  bindState(module);
  bindStates(module);
  motion
      .def("state_at",
           [](const PyMotion& self, const BodyName& body, double t) {
             const int index = bodyOf(self.scene.scene(), body);
             const Computing free;  // a path in contact is integrated as far as it is read
             return PyState(self.motion().stateAt(index, t));
           },
           nb::arg("body"), nb::arg("t"),
           "State of a body at a time from 0 to `end`, s; at the time of an impact, the state after it. Raises "
           "InputError for a time outside.")
      .def("state_before",
           [](const PyMotion& self, const EventName& event, const BodyName& body) {
             const int at = eventOf(*self.content, event), index = bodyOf(self.scene.scene(), body);
             const Computing free;
             return PyState(self.motion().stateBefore(at, index));
           },
           nb::arg("event"), nb::arg("body"),
           "State just before an event; of a body that takes no part in it, at its time.")
      .def("state_after",
           [](const PyMotion& self, const EventName& event, const BodyName& body) {
             const int at = eventOf(*self.content, event), index = bodyOf(self.scene.scene(), body);
             const Computing free;
             return PyState(self.motion().stateAfter(at, index));
           },
           nb::arg("event"), nb::arg("body"), "State just after an event.")
      .def("sample", &sampled, nb::arg("bodies"), nb::arg("times"), kSampleText);
}

}  // namespace carom::python
