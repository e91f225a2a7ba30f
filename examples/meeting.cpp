// SPDX-License-Identifier: MIT
// A ball that bounces and a crate meet in the air: where, and with which face, is nailed; when is left open.
#include <cmath>
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Scene ballAndCrate() {
  Scene scene;
  scene.materials.push_back({.name = "rubber", .elasticity = 0.85, .friction = 0.6});
  scene.materials.push_back({.name = "wood", .elasticity = 0.6, .friction = 0.4});
  Body floor, fence, ball, crate;
  floor.name = "floor", floor.fixed = true, floor.material = "wood", floor.shape = Plane{};
  fence.name = "fence", fence.fixed = true, fence.material = "wood", fence.shape = Box{{0.06, 1.2, 0.6}};
  fence.position = {0, 0, 0.3};
  ball.name = "ball", ball.material = "rubber", ball.mass = 0.6, ball.shape = Sphere{0.12};
  ball.position = {-1.9, 0.1, 1.1}, ball.velocity = {2.4, -0.1, -4.6}, ball.angular_velocity = {0, 4, 0};
  crate.name = "crate", crate.material = "wood", crate.mass = 0.9, crate.shape = Box{{0.3, 0.24, 0.2}};
  crate.position = {2.1, -0.15, 0.9}, crate.velocity = {-2.7, 0.12, 4.35}, crate.angular_velocity = {0.4, -2.2, 0.7};
  scene.bodies = {floor, fence, ball, crate};
  return scene;
}

void print(const char* what, const EditResult& result) {
  std::printf("%s: %s\n", what, nameOf(result.status));
  for (const ConstrainedNumber& number : result.residuals)
    std::printf("  %-50s %8.4f\n", number.name.c_str(), std::abs(number.value) < 1e-9 ? 0.0 : number.value);
  std::printf("  largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
}

}  // namespace

int main() {
  const Scene scene = ballAndCrate();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.1);
  edit.vary(velocity("ball"), velocity("crate"), angularVelocity("crate").weighted(0.5));

  // The place alone: the ball is above the fence when it meets the crate.
  edit.nail("ball", nthImpact(1, "crate")).position({-0.15, 0, 1.25});
  print("the place", edit.solve());

  // And how the crate stands then: on its side and level with the ball. Its x follows, for there the two touch.
  const Quat on_its_side(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);
  edit.nail("crate", nthImpact(1, "ball")).position({any, 0, 1.25}).orientation(on_its_side);
  const EditResult result = edit.solve();
  print("the place and the pose", result);
  for (const std::string& impact : result.sequence_after) std::printf("  %s\n", impact.c_str());
}
