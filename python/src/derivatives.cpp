// SPDX-License-Identifier: MIT
#include "python/src/derivatives.hpp"

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/settling.h"
#include "python/src/arrays.hpp"

namespace carom::python {
namespace {

/// carom.MotionTangent; keeps the motion, whose tape it reads.
struct PyMotionTangent {
  std::shared_ptr<const MotionContent> content;
  MotionTangent tangent;
};

PyGradient adjointOf(const PyMotion& motion, const SeedsArgument& seeds) {
  const std::vector<StateSeed> resolved = seedsIn(*motion.content, seeds);
  const Computing free;
  Reliability reliability;
  SceneGradient gradient =
      motion.content->withTape([&](DerivativeTape& tape) { return adjoint(tape, resolved, &reliability); });
  const auto& scene = motion.motion().scene;
  return {scene, std::move(gradient), PyReliability(reliability, *scene)};
}

PyMotionTangent tangentOf(const PyMotion& motion, const PyTangent& direction) {
  const Computing free;
  return motion.content->withTape([&](DerivativeTape& tape) {
    return PyMotionTangent{motion.content, tangent(tape, direction.values)};
  });
}

PyStateRate rateAt(const PyMotionTangent& self, const BodyName& body, std::optional<double> t,
                   const std::optional<EventName>& before, const std::optional<EventName>& after) {
  const Instant instant = instantIn(*self.content, {t, before, after});
  const int index = bodyOf(*self.content->motion.scene, body);
  const Computing free;
  return self.content->withTape([&](DerivativeTape&) { return PyStateRate{self.tangent.at(index, instant)}; });
}

double eventTime(const PyMotionTangent& self, const EventName& event) {
  return self.tangent.eventTime(eventOf(*self.content, event));
}

PyGradient settlingGradient(const PyMotion& motion, const EventName& event) {
  const int index = eventOf(*motion.content, event);
  const Computing free;
  Reliability reliability;
  SceneGradient gradient =
      motion.content->withTape([&](DerivativeTape& tape) { return settlesAtGradient(tape, index, &reliability); });
  return {motion.motion().scene, std::move(gradient), PyReliability(reliability, *motion.motion().scene)};
}

double settlingRate(const PyMotion& motion, const PyTangent& direction, const EventName& event) {
  const int index = eventOf(*motion.content, event);
  const Computing free;
  return motion.content->withTape([&](DerivativeTape& tape) { return settlesAtRate(tape, direction.values, index); });
}

template <class Value>
void bindVector(nb::class_<PyStateRate>& rate, const char* name, Value BodyStateRate::* member, const char* text) {
  rate.def_prop_ro(name, [member](const PyStateRate& self) { return view(self.rate.*member); }, text);
}

void bindRate(nb::module_& module) {
  nb::class_<PyStateRate> rate(module, "BodyStateRate", "Directional derivative of the state of a body.");
  bindVector(rate, "position", &BodyStateRate::position, "Of the position, m per unit.");
  bindVector(rate, "orientation", &BodyStateRate::orientation, "Of the orientation, as a world rotation vector.");
  bindVector(rate, "velocity", &BodyStateRate::velocity, "Of the velocity.");
  bindVector(rate, "angular_velocity", &BodyStateRate::angular_velocity, "Of the angular velocity.");
  bindVector(rate, "center_of_mass", &BodyStateRate::center_of_mass, "Of the position of the centre of mass.");
  bindVector(rate, "gravity", &BodyStateRate::gravity, "Of the gravity of the scene.");
  rate.def_prop_ro("inertia", [](const PyStateRate& self) { return copied<ReadOnly<-1, -1>>(Eigen::MatrixXd(self.rate.inertia)); }, kOwnArray,
                   "(3, 3), of its inertia tensor about the centre of mass, axes of the shape.")
      .def_prop_ro("size", [](const PyStateRate& self) { return copied<ReadOnly<-1>>(self.rate.size); }, kOwnArray,
                   "Of the dimensions of its shape; empty: constant.")
      .def_prop_ro("time", [](const PyStateRate& self) { return self.rate.time; }, "Of the instant; 0 at a fixed time.")
      .def_prop_ro("mass", [](const PyStateRate& self) { return self.rate.mass; }, "Of the body's mass.")
      .def("dot",
           [](const PyStateRate& self, const PySeed& seed) {
             const PlainArithmetic plain;
             return self.rate.dot(seed.weights);
           },
           nb::arg("seed"), "Rate of a functional: the sum of weights times rates.")
      .def("__repr__", [](const PyStateRate& self) {
        std::string text = "<BodyStateRate";
        for (const auto& [name, member] : {std::pair{" position=[", &BodyStateRate::position},
                                           std::pair{" velocity=[", &BodyStateRate::velocity}})
          text += name + numberText((self.rate.*member).x()) + ", " + numberText((self.rate.*member).y()) + ", " +
                  numberText((self.rate.*member).z()) + "]";
        return text + ">";
      });
}

constexpr const char* kAdjointText =
    "Reverse pass: gradient of the seeded functional (the sum of the seeds) with respect to all scene parameters. Its cost "
    "does not depend on the number of parameters; rows of one motion share their linearisations.\n\n"
    "Raises InputError for an invalid body, event or instant and for weights that are not finite, NotComputable if the "
    "derivative does not exist in doubles.";
constexpr const char* kForwardText =
    "Forward pass: directional derivative of the whole motion when the scene changes along `direction`.\n\n"
    "Raises InputError for a direction whose dimensions are not those of the scene, or numbers that are not finite; "
    "NotComputable as `adjoint`.";

}  // namespace

void bindDerivatives(nb::module_& module) {
  const auto none = nb::none();
  bindSeeds(module);
  bindReliability(module);
  bindSceneDerivatives(module);
  bindRate(module);
  bindSecondOrder(module);
  nb::class_<PyMotionTangent>(module, "MotionTangent", "Directional derivative of a motion.")
      .def("at", &rateAt, nb::arg("body"), nb::arg("t") = none, nb::kw_only(), nb::arg("before") = none,
           nb::arg("after") = none, "Of the state of a body at a time, s, or just before or after an event.")
      .def("event_time", &eventTime, nb::arg("event"), "Of the time of an event, s per unit.")
      .def("__repr__", [](const PyMotionTangent& self) {
        return "<MotionTangent of " + std::to_string(self.content->motion.scene->bodies.size()) + " bodies and " +
               std::to_string(self.content->motion.events.size()) + " events>";
      });
  module.def("adjoint", &adjointOf, nb::arg("motion"), nb::arg("seeds"), kAdjointText)
      .def("tangent", &tangentOf, nb::arg("motion"), nb::arg("direction"), kForwardText)
      .def("settles_at_gradient", &settlingGradient, nb::arg("motion"), nb::arg("event"),
           "Gradient of Event.settles_at with respect to all scene parameters. Raises NotComputable if the body is no ball, "
           "or does not settle on a flat face of a fixed body.")
      .def("settles_at_rate", &settlingRate, nb::arg("motion"), nb::arg("direction"), nb::arg("event"),
           "Its directional derivative.");
}

}  // namespace carom::python
