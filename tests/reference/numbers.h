// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "tests/reference/real.h"

namespace carom::reference {

/// The scene's numbers, converted exactly. Each can be nudged on its own; what follows from several of them (mass from
/// density and size, inertia from shape and mass, momentum from orientation and spin) is worked out afterwards.
struct BodyNumbers {
  enum class Kind { sphere, box, plane };
  Kind kind = Kind::sphere;
  bool moving = false, kinematic = false;
  Real gravity_factor = 1;
  RVec size;          ///< radius, or full edge lengths
  RVec plane_normal;  ///< unit, in the shape's frame
  Real plane_offset;
  int material = -1;  ///< -1: a default Material

  bool has_density = false, inertia_derived = true;
  Real mass_or_density;
  RVec moments;
  RMat axes = RMat::identity();  ///< principal to shape axes

  RVec position, velocity, spin;
  RMat orientation = RMat::identity();  ///< shape to world
  RVec surface_velocity, surface_spin;  ///< shape axes; of a body that impacts do not move

  Real mass() const {
    if (!has_density) return mass_or_density;
    if (kind == Kind::sphere) return mass_or_density * pi() * 4 / 3 * size[0] * size[0] * size[0];
    return mass_or_density * size[0] * size[1] * size[2];
  }
  /// Of the material of its surface at p, beside the body's own, along the surface with this normal.
  RVec surfaceVelocity(const RVec& x, const RMat& R, const RVec& p, const RVec& normal) const {
    const RVec B = R * surface_velocity + cross(R * surface_spin, p - x);
    return B - dot(normal, B) * normal;
  }
  bool surfaceMoves() const {
    const auto squares = dot(surface_velocity, surface_velocity) + dot(surface_spin, surface_spin);
    return squares > 0;
  }
  bool massive() const { return moving && !kinematic; }
  RVec inertia() const {
    if (kinematic) return {1, 1, 1};  // turns about a fixed axis
    if (!inertia_derived) return moments;
    const RVec square = times(size, size);
    if (kind == Kind::sphere) return (mass() * 2 / 5 * square[0]) * RVec{1, 1, 1};
    return (mass() / 12) * RVec{square[1] + square[2], square[2] + square[0], square[0] + square[1]};
  }
  static Real pi() { return acos(Real(-1)); }
};

struct MaterialNumbers {
  Real elasticity = 0.5, friction = 0.5, tangential_elasticity = 0;
  Combine combine_elasticity = Combine::average, combine_friction = Combine::average;
};

struct TiltNumbers {
  int body = -1, impact = 1;
  std::array<Real, 2> value{};
};

struct SceneNumbers {
  RVec gravity;
  std::vector<MaterialNumbers> materials;
  std::vector<BodyNumbers> bodies;
  std::vector<TiltNumbers> tilts;
};

inline int findName(const auto& list, const std::string& name) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].name == name) return static_cast<int>(i);
  }
  throw std::invalid_argument("the reference knows no '" + name + "'");
}

inline BodyNumbers numbersOf(const Scene& scene, const Body& body) {
  BodyNumbers n;
  n.moving = !body.fixed;
  if (const auto* sphere = std::get_if<Sphere>(&body.shape)) {
    n.kind = BodyNumbers::Kind::sphere, n.size[0] = sphere->radius;
  } else if (const auto* box = std::get_if<Box>(&body.shape)) {
    n.kind = BodyNumbers::Kind::box, n.size = RVec(box->size);
  } else {
    const auto& plane = std::get<Plane>(body.shape);
    n.kind = BodyNumbers::Kind::plane, n.plane_normal = unit(RVec(plane.normal)), n.plane_offset = plane.offset;
  }
  n.material = body.material.empty() ? -1 : findName(scene.materials, body.material);
  n.position = RVec(body.position);
  n.orientation = rotationOf(body.orientation);
  n.surface_velocity = RVec(body.surface_velocity), n.surface_spin = RVec(body.surface_angular_velocity);
  if (!n.moving) return n;
  n.velocity = RVec(body.velocity);
  n.spin = RVec(body.angular_velocity);
  n.kinematic = body.kinematic;
  n.gravity_factor = n.kinematic ? 0 : body.gravity_factor;
  if (n.kinematic) return n;
  n.has_density = body.density.has_value();
  n.mass_or_density = n.has_density ? *body.density : body.mass.value();
  n.inertia_derived = body.inertia.source == Inertia::Source::derived;
  n.moments = RVec(body.inertia.moments);
  n.axes = rotationOf(body.inertia.axes);
  return n;
}

inline SceneNumbers numbersOf(const Scene& scene) {
  SceneNumbers n;
  n.gravity = RVec(scene.gravity);
  for (const Material& m : scene.materials) {
    n.materials.push_back(
        {m.elasticity, m.friction, m.tangential_elasticity, m.combine_elasticity, m.combine_friction});
  }
  for (const Body& body : scene.bodies) n.bodies.push_back(numbersOf(scene, body));
  for (const Tilt& tilt : scene.tilts) {
    n.tilts.push_back({findName(scene.bodies, tilt.body), tilt.impact, {tilt.value.x(), tilt.value.y()}});
  }
  return n;
}

}  // namespace carom::reference
