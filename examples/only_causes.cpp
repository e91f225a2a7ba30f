// SPDX-License-Identifier: MIT
// The throw stays as it is. How springy hammer and floor are, and how the hammer's mass is spread, alone bring it to a
// place after its bounces.
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Scene hammerAboveFloor() {
  Scene scene;
  scene.materials.push_back({.name = "steel", .elasticity = 0.7, .friction = 0.3});
  scene.materials.push_back({.name = "slate", .elasticity = 0.8, .friction = 0.4});
  Body floor, hammer;
  floor.name = "floor", floor.fixed = true, floor.material = "slate", floor.shape = Plane{};
  hammer.name = "hammer", hammer.material = "steel", hammer.mass = 0.6;
  CompoundPart handle, head;
  handle.shape = Cylinder{0.014, 0.28};
  head.shape = Box{{0.12, 0.04, 0.04}}, head.position = {0, 0, 0.16};
  hammer.shape = Compound{{handle, head}};
  hammer.position = {-0.8, 0, 0.7}, hammer.velocity = {1.5, 0.1, 1.2}, hammer.angular_velocity = {0.6, -4, 0.4};
  scene.bodies = {floor, hammer};
  return scene;
}

}  // namespace

int main() {
  const Scene scene = hammerAboveFloor();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.0);
  edit.nail("hammer", 0.9).position({0.59, 0.03, 0.23});

  // Elasticity alone does not suffice; the answer says why, and what would help.
  edit.vary(elasticity("steel").within(0.1, 0.95), elasticity("slate").within(0.1, 0.95));
  EditResult result = edit.solve();
  std::printf("elasticity alone: %s\n", result.solved() ? "solved" : "not solved");
  for (const WhyNot::Help& help : result.why_not.would_help)
    if (help.control.vary == "inertia") std::printf("  would help: %s\n", help.name.c_str());

  edit.vary(inertia("hammer"));
  result = edit.solve();
  std::printf("with inertia: %s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    std::printf("  %-26s %8.5f -> %8.5f\n", number.name.c_str(), number.before, number.after);
  for (const ConstrainedNumber& number : result.residuals)
    std::printf("  %-32s %8.5f (wanted %.5f)\n", number.name.c_str(), number.value, number.target);
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
}
