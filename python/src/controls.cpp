// SPDX-License-Identifier: MIT
#include "editing/control.h"

#include "adjoint/base/errors.h"
#include "python/src/edit.hpp"

namespace carom::python {
namespace {

/// A bound for all components, or one for each.
using Bounds = std::optional<std::variant<double, std::vector<double>>>;
using Components = std::optional<std::vector<std::string>>;

std::vector<double> boundsOf(const Bounds& bounds) {
  if (!bounds) return {};
  if (const auto* one = std::get_if<double>(&*bounds)) return {*one};
  return std::get<std::vector<double>>(*bounds);
}

Control completed(Control control, const Bounds& min, const Bounds& max, double weight, const Components& components) {
  control.min = boundsOf(min);
  control.max = boundsOf(max);
  control.weight = weight;
  if (components && components->empty())
    throw InputError("components", "found none, expected at least one; None stands for all");
  if (components) control.components = *components;
  return control;
}

std::string reprOfControl(const Control& control) {
  const std::string& of = control.body.empty() ? control.material : control.body;
  std::string text = "<Control " + control.vary + (of.empty() ? "" : " of '" + of + "'");
  if (control.vary == "tilt") text += ", impact " + std::to_string(control.impact);
  for (std::size_t i = 0; i < control.components.size(); ++i)
    text += (i == 0 ? ", " : " and ") + control.components[i];
  return text + ">";
}

/// A function of carom: velocity("ball", min=..., max=..., weight=..., components=["x"]).
void bindKind(nb::module_& module, const char* name, const char* argument, Control (*make)(std::string), const char* text) {
  const auto none = nb::none();
  module.def(name,
             [make](const std::string& of, const Bounds& min, const Bounds& max, double weight,
                    const Components& components) { return completed(make(of), min, max, weight, components); },
             nb::arg(argument), nb::kw_only(), nb::arg("min") = none, nb::arg("max") = none, nb::arg("weight") = 1.0,
             nb::arg("components") = none, text);
}

void bindOtherKinds(nb::module_& module) {
  const auto none = nb::none();
  module.def("tilt",
             [](const std::string& body, int impact, const Bounds& min, const Bounds& max, double weight,
                const Components& components) { return completed(tilt(body, impact), min, max, weight, components); },
             nb::arg("body"), nb::arg("impact") = 1, nb::kw_only(), nb::arg("min") = none, nb::arg("max") = none,
             nb::arg("weight") = 1.0, nb::arg("components") = none,
             "Varies the tilt of the contact normal at the n-th impact of a body.");
  module.def("gravity",
             [](const Bounds& min, const Bounds& max, double weight, const Components& components) {
               return completed(gravity(), min, max, weight, components);
             },
             nb::kw_only(), nb::arg("min") = none, nb::arg("max") = none, nb::arg("weight") = 1.0,
             nb::arg("components") = none, "Varies gravity, m/s^2.");
}

}  // namespace

std::vector<Control> controlsIn(const nb::args& arguments) {
  std::vector<Control> all(arguments.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (!nb::try_cast<Control>(arguments[k], all[k]))
      throw nb::type_error(("expected controls such as carom.velocity('ball'), found " + pythonText(nb::repr(arguments[k]))).c_str());
  return all;
}

void bindControls(nb::module_& module) {
  nb::class_<Control>(module, "Control",
                      "Scene parameters that an edit may change; the functions velocity, elasticity and so on make them. "
                      "min, max: bounds, SI, one for all components or one each. weight: above 1 a change costs more. "
                      "components: names of those that vary, such as 'x' or 'radius'.")
      .def_ro("vary", &Control::vary, "Kind of parameter.")
      .def_ro("body", &Control::body, "Of kinds that belong to a body; else empty.")
      .def_ro("material", &Control::material, "Of kinds that belong to a material; else empty.")
      .def_ro("impact", &Control::impact, "Of a tilt.")
      .def_ro("components", &Control::components, "That vary; empty: all.")
      .def_ro("min", &Control::min, "SI; empty: physical bounds only.")
      .def_ro("max", &Control::max, "SI; empty: physical bounds only.")
      .def_ro("weight", &Control::weight, "In the cost (weight change / natural scale)^2.")
      .def("__repr__", &reprOfControl);
  bindKind(module, "position", "body", &position, "Varies the initial position of a body, m.");
  bindKind(module, "orientation", "body", &orientation, "Varies the initial orientation of a body.");
  bindKind(module, "velocity", "body", &velocity, "Varies the initial velocity of a body, m/s.");
  bindKind(module, "angular_velocity", "body", &angularVelocity, "Varies the initial angular velocity, rad/s.");
  bindKind(module, "surface_velocity", "body", &surfaceVelocity,
           "Varies the velocity of the surface of a fixed or kinematic body, m/s, in its axes.");
  bindKind(module, "surface_angular_velocity", "body", &surfaceAngularVelocity,
           "Varies the angular velocity of the surface of a fixed or kinematic body, rad/s, in its axes.");
  bindKind(module, "elasticity", "material", &elasticity, "Varies the coefficient of restitution of a material.");
  bindKind(module, "friction", "material", &friction, "Varies the Coulomb coefficient of a material.");
  bindKind(module, "tangential_elasticity", "material", &tangentialElasticity,
           "Varies the coefficient of tangential restitution of a material.");
  bindKind(module, "mass", "body", &mass, "Varies the mass of a body, kg.");
  bindKind(module, "inertia", "body", &inertia, "Varies the principal moments of inertia of a body, kg m^2.");
  bindKind(module, "size", "body", &size, "Varies the dimensions of the shape of a body, m.");
  bindOtherKinds(module);
}

}  // namespace carom::python
