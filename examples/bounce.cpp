// SPDX-License-Identifier: MIT
// The bounce that Warp optimises: a ball is thrown off floor and wall into a target. What the edit finds is compared
// with the closed form.
#include <cmath>
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

constexpr double kElasticity = 0.9267, kRadius = 0.1, kFace = 1.75, kDuration = 0.6;
const Vec3 kTarget(-2, 0, 1.5);

Scene floorAndWall() {
  Scene scene;
  scene.gravity = {0, 0, -9.80665};
  scene.materials.push_back({.name = "springs", .elasticity = kElasticity, .friction = 0});
  Body floor, wall, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "springs", floor.shape = Plane{};
  wall.name = "wall", wall.fixed = true, wall.material = "springs", wall.shape = Box{{0.5, 2, 2}};
  wall.position = {kFace + 0.25, 0, 1};
  ball.name = "ball", ball.material = "springs", ball.mass = 1, ball.shape = Sphere{kRadius};
  ball.position = {-0.5, 0, 1}, ball.velocity = {5, 0, -5};
  scene.bodies = {floor, wall, ball};
  return scene;
}

// Up to the wall at one speed, and back at e times that: what remains of the time decides.
double speedTowardsWall(double from) {
  const double way = kFace - kRadius - from, back = kFace - kRadius - kTarget.x();
  return (back + kElasticity * way) / (kElasticity * kDuration);
}

}  // namespace

int main() {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, kDuration);
  edit.vary(velocity("ball"));
  edit.nail("ball", kDuration).position(kTarget);
  const EditResult result = edit.solve();
  const Vec3 v = result.scene.bodies[2].velocity;
  std::printf("%s, thrown at (%.6f, %.6f)\n", nameOf(result.status), v.x(), v.z());
  for (const std::string& impact : result.sequence_after) std::printf("  %s\n", impact.c_str());
  std::printf("along x the closed form says %.6f, off by less than 1e-12: %s\n", speedTowardsWall(-0.5),
              std::abs(v.x() - speedTowardsWall(-0.5)) < 1e-12 * v.x() ? "yes" : "no");
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
}
