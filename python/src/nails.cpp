// SPDX-License-Identifier: MIT
#include "editing/nail.h"

#include "python/src/arrays.hpp"
#include "python/src/edit.hpp"

namespace carom::python {
namespace {

/// A member of Nail that takes three components.
using SetThree = Nail& (Nail::*)(Wanted, Wanted, Wanted);
using SetOne = Nail& (Nail::*)(Wanted);

/// Calls `set`, alone: an edit that is being solved does not change.
template <class Set>
PyNail& changed(PyNail& self, Set set) {
  const OneAtATime::Use use(self.content->one, "the edit");
  set(self.nail);
  return self;
}

void bindThree(nb::class_<PyNail>& nail, const char* name, SetThree member, const char* text) {
  nail.def(name,
           [member](PyNail& self, const WantedArgument& x, const WantedArgument& y, const WantedArgument& z) -> PyNail& {
             return changed(self, [&](Nail& to) { (to.*member)(wantedOf(x, "x"), wantedOf(y, "y"), wantedOf(z, "z")); });
           },
           nb::arg("x").none(), nb::arg("y").none(), nb::arg("z").none(), nb::rv_policy::none, text);
}

void bindOne(nb::class_<PyNail>& nail, const char* name, SetOne member, const char* text) {
  nail.def(name,
           [member](PyNail& self, const WantedArgument& value) -> PyNail& {
             return changed(self, [&](Nail& to) { (to.*member)(wantedOf(value, "value")); });
           },
           nb::arg("value").none(), nb::rv_policy::none, text);
}

PyNail& nailedOrientation(PyNail& self, const ArrayLike& quaternion) {
  const Quat q = quaternionOf(quaternion, "quaternion");
  return changed(self, [&](Nail& to) { to.orientation(q); });
}

PyNail& nailedPoint(PyNail& self, const ArrayLike& body_point, const WantedArgument& x, const WantedArgument& y,
                    const WantedArgument& z) {
  const Vec3 point = vectorOf(body_point, "body_point");
  return changed(self, [&](Nail& to) { to.point(point, wantedOf(x, "x"), wantedOf(y, "y"), wantedOf(z, "z")); });
}

PyNail& nailedDistance(PyNail& self, const std::string& to, const WantedArgument& value) {
  return changed(self, [&](Nail& nail) { nail.distance(to, wantedOf(value, "value")); });
}

PyNail& nailedApproach(PyNail& self, const std::string& to, const WantedArgument& value, const Interval& during) {
  return changed(self, [&](Nail& nail) { nail.closestApproach(to, wantedOf(value, "value"), during); });
}

void bindComponents(nb::class_<PyNail>& nail) {
  bindThree(nail, "position", &Nail::position, "m, component by component.");
  bindThree(nail, "velocity", &Nail::velocity, "m/s, component by component.");
  bindThree(nail, "angular_velocity", &Nail::angularVelocity, "rad/s, world axes, component by component.");
  bindThree(nail, "contact", &Nail::contact,
            "m, world: where the body touches in the impact, the mean of its contacts; only for nails at an impact. Leave "
            "the component along the normal free.");
  bindOne(nail, "time", &Nail::time, "s, of the impact, or of coming to rest.");
  bindOne(nail, "speed", &Nail::speed, "m/s, of the velocity.");
  bindOne(nail, "kinetic_energy", &Nail::kineticEnergy, "J, translational and rotational.");
  bindOne(nail, "impulse", &Nail::impulse, "N s, on the body in the impact; only for nails at an impact.");
  bindOne(nail, "height", &Nail::height, "m, of the lowest point, opposite to gravity (along z without gravity).");
}

constexpr const char* kNailText =
    "A constraint on a body at one moment; Edit.nail makes them. Each function adds a target, or replaces it, and gives the "
    "nail itself. A target is a number, a range (0.1, 0.3), (0.1, None) or at_least(0.1), or None, which leaves it free.";

}  // namespace

void bindNails(nb::module_& module) {
  nb::class_<PyNail> nail(module, "Nail", kNailText);
  bindComponents(nail);
  const auto self = nb::rv_policy::none;
  nail.def("orientation", &nailedOrientation, nb::arg("quaternion"), self, "Unit quaternion w, x, y, z, shape to world.")
      .def("point", &nailedPoint, nb::arg("body_point"), nb::arg("x").none(), nb::arg("y").none(), nb::arg("z").none(),
           self, "m: position in the world of a point in the axes of the shape, component by component.")
      .def("distance", &nailedDistance, nb::arg("to"), nb::arg("value").none(), self,
           "m, between the surfaces of the body and another one, greater than 0.")
      .def("closest_approach", &nailedApproach, nb::arg("to"), nb::arg("value").none(), nb::arg("during") = nb::none(),
           self, "m, the minimum distance of the two over an interval of its own (default: the whole motion).")
      .def("relative_to",
           [](PyNail& of, const std::string& body) -> PyNail& {
             return changed(of, [&](Nail& to) { to.relativeTo(body); });
           },
           nb::arg("body"), self, "All targets are relative to another body, in the axes of its shape; '' resets it.")
      .def("soft", [](PyNail& of, double weight) -> PyNail& { return changed(of, [&](Nail& to) { to.soft(weight); }); },
           nb::arg("weight") = 1.0, self, "A term of the objective in place of exact targets.")
      .def("avoid",
           [](PyNail& of, const Region& region) -> PyNail& { return changed(of, [&](Nail& to) { to.avoid(region); }); },
           nb::arg("region"), self, "The body stays out of a region, during the region's own interval.")
      .def("inside",
           [](PyNail& of, const Region& region) -> PyNail& { return changed(of, [&](Nail& to) { to.inside(region); }); },
           nb::arg("region"), self, "The body stays within a region.")
      .def("__repr__", [](const PyNail& of) { return "<Nail of " + of.text + ">"; });
}

}  // namespace carom::python
