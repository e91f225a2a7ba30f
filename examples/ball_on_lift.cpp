// SPDX-License-Identifier: MIT
// A ball is thrown onto a lift that goes up and to the side, bounces on it and comes to roll. The edit finds the throw that brings
// it to a mark on the platform.
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Scene liftAndBall() {
  Scene scene;
  scene.gravity = {0, 0, -9.81};
  scene.materials.push_back({.name = "rubber", .elasticity = 0.5, .friction = 0.4});
  Body floor, lift, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "rubber", floor.shape = Plane{};
  lift.name = "lift", lift.kinematic = true, lift.material = "rubber", lift.shape = Box{{1.2, 0.8, 0.06}};
  lift.position = {0.5, 0, 0.3}, lift.velocity = {0.15, 0, 0.35};
  ball.name = "ball", ball.material = "rubber", ball.mass = 0.2, ball.shape = Sphere{0.06};
  ball.position = {-0.6, 0.2, 1}, ball.velocity = {1.8, -0.3, 0.9};
  scene.bodies = {floor, lift, ball};
  return scene;
}

}  // namespace

int main() {
  const Scene scene = liftAndBall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("ball"));
  edit.nail("ball", 2.0).position(0.25, -0.1, any).relativeTo("lift");
  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed) std::printf("  %-20s %6.3f -> %6.3f\n", number.name.c_str(), number.before, number.after);
  const Arc& last = result.motion.world_lines[2].arcs.back();
  std::printf("  from %.3f s on it %ss on the lift\n", last.start(), nameOf(last.kind()));
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
  return result.solved() ? 0 : 1;
}
