// SPDX-License-Identifier: MIT
// Six blocks stand on each other. A light ball strikes the one at the top, which friction holds, and the edit finds the throw after
// which it comes down on a mark on the floor.
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Body block(const char* name, double x, double z) {
  Body body;
  body.name = name, body.material = "wood", body.mass = 2, body.shape = Box{{0.3, 0.3, 0.2}}, body.position = {x, 0, z};
  return body;
}

Scene pyramidAndBall() {
  Scene scene;
  scene.gravity = {0, 0, -9.81};
  scene.materials.push_back({.name = "wood", .elasticity = 0.6, .friction = 0.5});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "wood", floor.shape = Plane{};
  ball.name = "ball", ball.material = "wood", ball.mass = 0.05, ball.shape = Sphere{0.05};
  ball.position = {-1, 0.02, 1.6}, ball.velocity = {2, 0, 0.5};
  scene.bodies = {floor, block("left", -0.32, 0.1), block("middle", 0, 0.1), block("right", 0.32, 0.1),
                  block("upper left", -0.16, 0.3), block("upper right", 0.16, 0.3), block("top", 0, 0.5), ball};
  return scene;
}

}  // namespace

int main() {
  const Scene scene = pyramidAndBall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", nthImpact(2)).position(1.15, 0.2, any);
  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed) std::printf("  %-20s %6.3f -> %6.3f\n", number.name.c_str(), number.before, number.after);
  const BodyState before = result.motion.stateAt("top", 0), after = result.motion.stateAt("top", 1.6);
  std::printf("the top stays where it is, to the last bit: %s\n", before.position == after.position ? "yes" : "no");
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
  return result.solved() ? 0 : 1;
}
