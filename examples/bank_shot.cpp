// SPDX-License-Identifier: MIT
// The last scene of docs/tutorial.md in C++: a ball strikes a spot on a wall and goes into a crate.
#include <cmath>
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

CompoundPart board(const Vec3& size, const Vec3& position) {
  CompoundPart part;
  part.shape = Box{size}, part.position = position;
  return part;
}

Scene throwAtAWall() {
  Scene scene;
  scene.materials.push_back({.name = "rubber", .elasticity = 0.8, .friction = 0.5});
  scene.materials.push_back({.name = "wood", .elasticity = 0.6, .friction = 0.4});
  scene.materials.push_back({.name = "felt", .elasticity = 0.2, .friction = 0.6});
  Body floor, wall, crate, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "wood", floor.shape = Plane{};
  wall.name = "wall", wall.fixed = true, wall.material = "wood", wall.shape = Box{{0.1, 3, 2.5}};
  wall.position = {3, 0, 1.25};
  crate.name = "crate", crate.fixed = true, crate.material = "felt", crate.position = {1.6, 0.6, 0};
  crate.shape = Compound{{board({0.6, 0.6, 0.02}, {0, 0, 0.01}), board({0.02, 0.6, 0.4}, {-0.29, 0, 0.2}),
                          board({0.02, 0.6, 0.4}, {0.29, 0, 0.2}), board({0.56, 0.02, 0.4}, {0, -0.29, 0.2}),
                          board({0.56, 0.02, 0.4}, {0, 0.29, 0.2})}};
  ball.name = "ball", ball.material = "rubber", ball.mass = 0.6, ball.shape = Sphere{0.12};
  ball.position = {0, 0, 1.2}, ball.velocity = {5, -0.2, 2.5};
  scene.bodies = {floor, wall, crate, ball};
  return scene;
}

double tidy(double x) { return std::abs(x) < 1e-6 ? 0 : x; }  // prints no "-0.000"

}  // namespace

int main() {
  const Scene scene = throwAtAWall();
  OdeContacts contacts(scene);      // collision detection
  Edit edit(scene, contacts, 1.4);  // 1.4 seconds
  edit.vary(velocity("ball"), angularVelocity("ball").weighted(0.5));
  edit.nail("ball", between(0.7, 1.3)).position({1.6, 0.6, 0.45}).velocity(any, any, atMost(-1));
  edit.nail("ball", nthImpact(1, "wall")).position({any, 0.25, 1.6});

  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    std::printf("  %-28s %7.3f -> %7.3f\n", number.name.c_str(), number.before, tidy(number.after));
  for (std::size_t i = 0; i < result.motion.events.size(); ++i)
    std::printf("  %.3f s: %s\n", result.motion.events[i].time,
                result.motion.describeEvent(static_cast<int>(i)).c_str());
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
  return result.solved() ? 0 : 1;
}
