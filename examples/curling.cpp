// SPDX-License-Identifier: MIT
// A curling stone is to rest on the tee behind a guard. As thrown it passes the guard on the lower side; the edit
// brings it round the other side: it slides, curls down the slope, and stops. Then: how far off on other ice.
#include <cmath>
#include <cstdio>

#include "adjoint/derivative/adjoint.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

// The axes are those of the sheet, which falls along y by three in a thousand.
Scene sheet() {
  Scene scene;
  scene.gravity = {0, 0.0294, -9.81};
  scene.materials.push_back({.name = "ice", .elasticity = 0.2, .friction = 0.01});
  scene.materials.push_back({.name = "granite", .elasticity = 0.7, .friction = 0.2});
  scene.materials.push_back({.name = "polished", .elasticity = 0.7, .friction = 0});
  for (Material& material : scene.materials) material.combine_friction = Combine::minimum;
  Body ice, guard, stone;
  ice.name = "ice", ice.fixed = true, ice.material = "ice", ice.shape = Plane{};
  guard.name = "guard", guard.fixed = true, guard.material = "polished", guard.shape = Cylinder{0.145, 0.11};
  guard.position = {7, 0, 0.055};
  stone.name = "stone", stone.material = "granite", stone.mass = 19, stone.shape = Cylinder{0.145, 0.11};
  stone.position = {0, 0, 0.055}, stone.velocity = {1.4, 0.05, 0};
  scene.bodies = {ice, guard, stone};
  return scene;
}

double tidy(double x) { return std::abs(x) < 1e-6 ? 0 : x; }  // prints no "-0.000"

}  // namespace

int main() {
  const Scene scene = sheet();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 20);
  edit.vary(velocity("stone").only({"x", "y"}));
  edit.nail("stone", atRest()).position({10, 0, any});

  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    std::printf("  %-24s %7.3f -> %7.3f\n", number.name.c_str(), number.before, tidy(number.after));
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");

  const std::vector<Arc>& arcs = result.motion.world_lines[2].arcs;
  for (auto k = static_cast<std::size_t>(result.motion.arcAt(2, 0)); k < arcs.size(); ++k)
    std::printf("  %6.3f s: %s\n", arcs[k].start(), nameOf(arcs[k].kind()));
  StateSeed along;
  along.body = 2, along.at = Instant::at(20), along.position = Vec3::UnitX();
  const SceneGradient gradient = adjoint(result.motion, {&along, 1});
  std::printf("a thousandth more friction: it stops %.3f m short\n", -0.001 * gradient.materials[0].friction);
  return result.solved() ? 0 : 1;
}
