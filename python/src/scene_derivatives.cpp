// SPDX-License-Identifier: MIT
#include <map>

#include "adjoint/base/errors.h"
#include "python/src/arrays.hpp"
#include "python/src/derivatives.hpp"

namespace carom::python {
namespace {

using NamedArrays = std::optional<std::map<std::string, ArrayLike>>;
using NamedNumbers = std::optional<std::map<std::string, double>>;

ReadOnly<-1, 3> bodyRows(const SceneDerivative& values, Vec3 BodyDerivative::* member) {
  std::vector<double> rows;
  for (const BodyDerivative& body : values.bodies)
    rows.insert(rows.end(), (body.*member).data(), (body.*member).data() + 3);
  return owning<ReadOnly<-1, 3>>(std::move(rows), {values.bodies.size(), 3});
}

template <class Part>
ReadOnly<-1> column(const std::vector<Part>& parts, double Part::* member) {
  std::vector<double> numbers;
  for (const Part& part : parts) numbers.push_back(part.*member);
  return owning<ReadOnly<-1>>(std::move(numbers), {parts.size()});
}

std::vector<ReadOnly<-1>> sizeRows(const SceneDerivative& values) {
  std::vector<ReadOnly<-1>> rows;
  for (const BodyDerivative& body : values.bodies) {
    const auto count = static_cast<std::size_t>(body.size.size());
    rows.push_back(owning<ReadOnly<-1>>({body.size.data(), body.size.data() + count}, {count}));
  }
  return rows;
}

ReadOnly<-1, 2> tiltRows(const SceneDerivative& values) {
  std::vector<double> rows;
  for (const Vec2& tilt : values.tilts) rows.insert(rows.end(), tilt.data(), tilt.data() + 2);
  return owning<ReadOnly<-1, 2>>(std::move(rows), {values.tilts.size(), 2});
}

template <class Derivative>
void bindRows(nb::class_<Derivative>& derivative, const char* name, Vec3 BodyDerivative::* member, const char* text) {
  derivative.def_prop_ro(name, [member](const Derivative& self) { return bodyRows(self.values, member); }, kOwnArray, text);
}
template <class Derivative>
void bindBodies(nb::class_<Derivative>& derivative, const char* name, double BodyDerivative::* member, const char* text) {
  derivative.def_prop_ro(name, [member](const Derivative& self) { return column(self.values.bodies, member); }, kOwnArray,
                         text);
}
template <class Derivative>
void bindMaterials(nb::class_<Derivative>& derivative, const char* name, double MaterialDerivative::* member,
                   const char* text) {
  derivative.def_prop_ro(name, [member](const Derivative& self) { return column(self.values.materials, member); },
                         kOwnArray, text);
}

/// The fields that both have, in the order of the scene.
template <class Derivative>
void bindFields(nb::class_<Derivative>& derivative) {
  bindRows(derivative, "position", &BodyDerivative::position, "(bodies, 3), of the positions, m");
  bindRows(derivative, "orientation", &BodyDerivative::orientation,
           "(bodies, 3), of the orientations as world rotation vectors, rad");
  bindRows(derivative, "velocity", &BodyDerivative::velocity, "(bodies, 3), of the velocities, m/s");
  bindRows(derivative, "angular_velocity", &BodyDerivative::angular_velocity,
           "(bodies, 3), of the angular velocities, rad/s");
  bindRows(derivative, "surface_velocity", &BodyDerivative::surface_velocity,
           "(bodies, 3), of the velocities of moving surfaces, m/s, axes of the shapes: by impacts, not by persistent contact; "
           "0 for bodies that impacts move");
  bindRows(derivative, "surface_angular_velocity", &BodyDerivative::surface_angular_velocity,
           "(bodies, 3), of the angular velocities of moving surfaces, rad/s, axes of the shapes");
  bindRows(derivative, "inertia", &BodyDerivative::inertia,
           "(bodies, 3), of the principal moments, kg m^2; unused where the inertia is derived.");
  bindBodies(derivative, "mass", &BodyDerivative::mass, "(bodies,), kg; used where the scene gives the mass.");
  bindBodies(derivative, "density", &BodyDerivative::density,
             "(bodies,), kg/m^3; used where the scene gives the density.");
  bindMaterials(derivative, "elasticity", &MaterialDerivative::elasticity,
                "(materials,), of the coefficients of restitution");
  bindMaterials(derivative, "friction", &MaterialDerivative::friction, "(materials,), of the Coulomb coefficients");
  bindMaterials(derivative, "tangential_elasticity", &MaterialDerivative::tangential_elasticity,
                "(materials,), of the coefficients of tangential restitution");
  derivative
      .def_prop_ro("size", [](const Derivative& self) { return sizeRows(self.values); }, kOwnArray,
                   "For each body an array, of the dimensions of its shape.")
      .def_prop_ro("tilts", [](const Derivative& self) { return tiltRows(self.values); }, kOwnArray, "(tilts, 2)")
      .def_prop_ro("gravity", [](const Derivative& self) { return view(self.values.gravity); }, "(3,), m/s^2");
}

void setVectors(const Scene& scene, SceneTangent& values, const NamedArrays& given, Vec3 BodyDerivative::* member,
                const char* where) {
  if (!given) return;
  for (const auto& [name, numbers] : *given)
    values.bodies[static_cast<std::size_t>(bodyIndex(scene, name))].*member = vectorOf(numbers, where);
}
void setBodies(const Scene& scene, SceneTangent& values, const NamedNumbers& given, double BodyDerivative::* member) {
  if (!given) return;
  for (const auto& [name, number] : *given)
    values.bodies[static_cast<std::size_t>(bodyIndex(scene, name))].*member = number;
}
void setMaterials(const Scene& scene, SceneTangent& values, const NamedNumbers& given, double MaterialDerivative::* member) {
  if (!given) return;
  for (const auto& [name, number] : *given)
    values.materials[static_cast<std::size_t>(materialIndex(scene, name))].*member = number;
}

void setSizes(const Scene& scene, SceneTangent& values, const NamedArrays& given) {
  if (!given) return;
  for (const auto& [name, array] : *given) {
    Eigen::VectorXd& size = values.bodies[static_cast<std::size_t>(bodyIndex(scene, name))].size;
    const auto numbers = numbersOf(array, "size", {static_cast<long>(size.size())});
    size = Eigen::Map<const Eigen::VectorXd>(numbers.data(), size.size());
  }
}

void setTilts(SceneTangent& values, const std::optional<ArrayLike>& given) {
  if (!given) return;
  const auto numbers = numbersOf(*given, "tilts", {static_cast<long>(values.tilts.size()), 2});
  for (std::size_t i = 0; i < values.tilts.size(); ++i) values.tilts[i] = Eigen::Map<const Vec2>(numbers.data() + 2 * i);
}

void makeTangent(PyTangent* self, const PyScene& of, const NamedArrays& position, const NamedArrays& orientation,
                 const NamedArrays& velocity, const NamedArrays& angular_velocity, const NamedArrays& inertia, const NamedNumbers& mass,
                 const NamedNumbers& density, const NamedArrays& size, const NamedNumbers& elasticity, const NamedNumbers& friction,
                 const NamedNumbers& tangential_elasticity, const std::optional<ArrayLike>& tilts,
                 const std::optional<ArrayLike>& gravity, const NamedArrays& surface_velocity,
                 const NamedArrays& surface_angular_velocity) {
  const Scene& scene = of.scene();
  SceneTangent values(scene);
  setVectors(scene, values, position, &BodyDerivative::position, "position");
  setVectors(scene, values, orientation, &BodyDerivative::orientation, "orientation");
  setVectors(scene, values, velocity, &BodyDerivative::velocity, "velocity");
  setVectors(scene, values, angular_velocity, &BodyDerivative::angular_velocity, "angular_velocity");
  setVectors(scene, values, surface_velocity, &BodyDerivative::surface_velocity, "surface_velocity");
  setVectors(scene, values, surface_angular_velocity, &BodyDerivative::surface_angular_velocity, "surface_angular_velocity");
  setVectors(scene, values, inertia, &BodyDerivative::inertia, "inertia");
  setBodies(scene, values, mass, &BodyDerivative::mass);
  setBodies(scene, values, density, &BodyDerivative::density);
  setSizes(scene, values, size);
  setMaterials(scene, values, elasticity, &MaterialDerivative::elasticity);
  setMaterials(scene, values, friction, &MaterialDerivative::friction);
  setMaterials(scene, values, tangential_elasticity, &MaterialDerivative::tangential_elasticity);
  setTilts(values, tilts);
  if (gravity) values.gravity = vectorOf(*gravity, "gravity");
  new (self) PyTangent{of, std::move(values)};
}

constexpr const char* kDirectionText =
    "A direction in the space of all scene parameters: their rates of change, by the names of bodies and materials; what "
    "is not named is 0. SceneTangent(scene, velocity={'ball': (1, 0, 0)}, elasticity={'court': 0.1}).";

std::string namesText(const Scene& scene) {
  return std::to_string(scene.bodies.size()) + " bodies and " + std::to_string(scene.materials.size()) + " materials";
}

}  // namespace

void bindSceneDerivatives(nb::module_& module) {
  const auto none = nb::none();
  nb::class_<PyTangent> tangent(module, "SceneTangent", kDirectionText);
  tangent
      .def("__init__", &makeTangent, nb::arg("scene"), nb::kw_only(), nb::arg("position") = none,
           nb::arg("orientation") = none, nb::arg("velocity") = none, nb::arg("angular_velocity") = none,
           nb::arg("inertia") = none, nb::arg("mass") = none, nb::arg("density") = none, nb::arg("size") = none,
           nb::arg("elasticity") = none, nb::arg("friction") = none, nb::arg("tangential_elasticity") = none,
           nb::arg("tilts") = none, nb::arg("gravity") = none, nb::arg("surface_velocity") = none,
           nb::arg("surface_angular_velocity") = none)
      .def("__repr__", [](const PyTangent& self) { return "<SceneTangent of " + namesText(self.scene.scene()) + ">"; });
  bindFields(tangent);
  nb::class_<PyGradient> gradient(module, "SceneGradient",
                                  "Gradient of a functional with respect to all scene parameters, per unit of each; rows "
                                  "are bodies and materials in the order of the scene.");
  bindFields(gradient);
  gradient.def_prop_ro("reliability", [](const PyGradient& self) { return self.reliability; }, nb::rv_policy::move,
                       "Where derivatives nearly do not exist on the way; look at it before the gradient.")
      .def("dot",
           [](const PyGradient& self, const PyTangent& direction) {
             const PlainArithmetic plain;
             return self.values.dot(direction.values);
           },
           nb::arg("direction"),
           "Directional derivative: the sum of products of all fields. Raises InputError if the dimensions differ.")
      .def("__repr__", [](const PyGradient& self) {
        const bool reliable = self.reliability.reliability.reliable && self.reliability.unreliable_for.empty();
        return "<SceneGradient of " + namesText(*self.scene) + (reliable ? ", reliable>" : ", see reliability>");
      });
}

}  // namespace carom::python
