// SPDX-License-Identifier: MIT
#pragma once

#include "tests/reference/numbers.h"
#include "tests/reference/replay.h"

namespace carom::reference {

/// One kind of number that can vary: how many the scene has, how one is nudged, where its derivative stands. A new
/// control adds a row.
struct KnobKind {
  const char* name;
  std::vector<int> (*components)(const SceneNumbers&, int index);  ///< empty where there is none
  int (*count)(const SceneNumbers&);
  void (*nudge)(SceneNumbers&, int index, int component, const Real& change);
  double& (*entry)(SceneDerivative&, int index, int component);
};

inline std::vector<int> firstComponents(int n) {
  std::vector<int> v(n);
  for (int i = 0; i < n; ++i) v[i] = i;
  return v;
}

inline const std::vector<KnobKind>& knobKinds() {
  using N = SceneNumbers;
  using D = SceneDerivative;
  static constexpr auto one = [](const N&) { return 1; };
  static constexpr auto materials = [](const N& n) { return static_cast<int>(n.materials.size()); };
  static constexpr auto bodies = [](const N& n) { return static_cast<int>(n.bodies.size()); };
  static constexpr auto tilts = [](const N& n) { return static_cast<int>(n.tilts.size()); };
  static constexpr auto scalar = [](const N&, int) { return firstComponents(1); };
  static constexpr auto two = [](const N&, int) { return firstComponents(2); };
  static constexpr auto three = [](const N&, int) { return firstComponents(3); };
  static constexpr auto if_moving = [](const N& n, int i) { return firstComponents(n.bodies[i].moving ? 3 : 0); };
  static constexpr auto if_surface = [](const N& n, int i) { return firstComponents(n.bodies[i].surfaceMoves() ? 3 : 0); };
  static const std::vector<KnobKind> kinds = {
      {"gravity", three, one, [](N& n, int, int c, const Real& h) { n.gravity[c] += h; },
       [](D& d, int, int c) -> double& { return d.gravity[c]; }},
      {"elasticity", scalar, materials, [](N& n, int i, int, const Real& h) { n.materials[i].elasticity += h; },
       [](D& d, int i, int) -> double& { return d.materials[i].elasticity; }},
      {"friction", scalar, materials, [](N& n, int i, int, const Real& h) { n.materials[i].friction += h; },
       [](D& d, int i, int) -> double& { return d.materials[i].friction; }},
      {"tangential_elasticity", scalar, materials,
       [](N& n, int i, int, const Real& h) { n.materials[i].tangential_elasticity += h; },
       [](D& d, int i, int) -> double& { return d.materials[i].tangential_elasticity; }},
      {"position", three, bodies, [](N& n, int i, int c, const Real& h) { n.bodies[i].position[c] += h; },
       [](D& d, int i, int c) -> double& { return d.bodies[i].position[c]; }},
      {"orientation", three, bodies,
       [](N& n, int i, int c, const Real& h) {
         n.bodies[i].orientation = rotationBy(axisVector(c, h)) * n.bodies[i].orientation;
       },
       [](D& d, int i, int c) -> double& { return d.bodies[i].orientation[c]; }},
      {"velocity", if_moving, bodies, [](N& n, int i, int c, const Real& h) { n.bodies[i].velocity[c] += h; },
       [](D& d, int i, int c) -> double& { return d.bodies[i].velocity[c]; }},
      {"angular_velocity", if_moving, bodies, [](N& n, int i, int c, const Real& h) { n.bodies[i].spin[c] += h; },
       [](D& d, int i, int c) -> double& { return d.bodies[i].angular_velocity[c]; }},
      {"surface_velocity", if_surface, bodies, [](N& n, int i, int c, const Real& h) { n.bodies[i].surface_velocity[c] += h; },
       [](D& d, int i, int c) -> double& { return d.bodies[i].surface_velocity[c]; }},
      {"surface_angular_velocity", if_surface, bodies, [](N& n, int i, int c, const Real& h) { n.bodies[i].surface_spin[c] += h; },
       [](D& d, int i, int c) -> double& { return d.bodies[i].surface_angular_velocity[c]; }},
      {"mass", [](const N& n, int i) { return firstComponents(n.bodies[i].massive() && !n.bodies[i].has_density); },
       bodies, [](N& n, int i, int, const Real& h) { n.bodies[i].mass_or_density += h; },
       [](D& d, int i, int) -> double& { return d.bodies[i].mass; }},
      {"density", [](const N& n, int i) { return firstComponents(n.bodies[i].massive() && n.bodies[i].has_density); },
       bodies, [](N& n, int i, int, const Real& h) { n.bodies[i].mass_or_density += h; },
       [](D& d, int i, int) -> double& { return d.bodies[i].density; }},
      {"inertia",
       [](const N& n, int i) { return firstComponents(n.bodies[i].massive() && !n.bodies[i].inertia_derived ? 3 : 0); },
       bodies, [](N& n, int i, int c, const Real& h) { n.bodies[i].moments[c] += h; },
       [](D& d, int i, int c) -> double& { return d.bodies[i].inertia[c]; }},
      {"size",
       [](const N& n, int i) {
         using Kind = BodyNumbers::Kind;
         const Kind kind = n.bodies[i].kind;
         return firstComponents(kind == Kind::sphere ? 1 : kind == Kind::box ? 3 : 0);
       },
       bodies, [](N& n, int i, int c, const Real& h) { n.bodies[i].size[c] += h; },
       [](D& d, int i, int c) -> double& { return d.bodies[i].size[c]; }},
      {"tilt", two, tilts, [](N& n, int i, int c, const Real& h) { n.tilts[i].value[c] += h; },
       [](D& d, int i, int c) -> double& { return d.tilts[i][c]; }},
  };
  return kinds;
}

}  // namespace carom::reference
