// SPDX-License-Identifier: MIT
// A ball falls, bounces once, and rises: how its height at time t depends on everything, in one reverse pass.
#include <cmath>
#include <cstdio>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  const double g = 9.81, radius = 0.1, drop = 0.9, e = 0.8, t = 0.7;  // drop: from the ball's lowest point
  Scene scene;
  scene.materials.push_back({.name = "rubber", .elasticity = e, .friction = 0});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "rubber", floor.shape = Plane{};
  ball.name = "ball", ball.material = "rubber", ball.shape = Sphere{radius}, ball.mass = 1;
  ball.position = {0, 0, radius + drop};
  scene.bodies = {floor, ball};

  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, t);
  StateSeed height;  // the functional: z of the ball at time t
  height.body = bodyIndex(scene, "ball");
  height.at = Instant::at(t);
  height.position = {0, 0, 1};
  const SceneGradient gradient = adjoint(motion, {&height, 1});

  // Falls for T, leaves at e v; then z(t) = radius + e v (t - T) - g/2 (t - T)^2, T and v depending on the drop.
  const double T = std::sqrt(2 * drop / g), v = g * T, rest = t - T;
  const double by_elasticity = v * rest;
  const double by_height = e * rest * g / v - e + g * rest / v;  // dv = g dh/v, dT = dh/v
  std::printf("z(t)                 %.9f\n", motion.stateAt("ball", t).position.z());
  std::printf("dz/d(elasticity)     %.9f   closed form %.9f\n", gradient.materials[0].elasticity, by_elasticity);
  std::printf("dz/d(start height)   %.9f   closed form %.9f\n", gradient.bodies[1].position.z(), by_height);
  std::printf("dz/d(start velocity) %.9f\n", gradient.bodies[1].velocity.z());
}
