// SPDX-License-Identifier: MIT
#include "tests/edits/ball_above.h"

namespace carom::test {

Scene ballAbove(const Vec3& velocity) {
  Scene scene;
  scene.materials.push_back({.name = "m", .elasticity = 0.7, .friction = 0});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "m", floor.shape = Plane{};
  ball.name = "ball", ball.material = "m", ball.shape = Sphere{0.1}, ball.mass = 0.2;
  ball.position = {0, 0, 1}, ball.velocity = velocity;
  scene.bodies = {floor, ball};
  return scene;
}

}  // namespace carom::test
