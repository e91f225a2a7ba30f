// SPDX-License-Identifier: MIT
// A die is thrown so that it strikes the table with a chosen face down at its third impact: each of the six faces.
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

constexpr double kSide = 0.03;

Scene dieAndTable() {
  Scene scene;
  scene.materials.push_back({.name = "resin", .elasticity = 0.75, .friction = 0.25});
  scene.materials.push_back({.name = "walnut", .elasticity = 0.7, .friction = 0.3});
  Body table, die;
  table.name = "table", table.fixed = true, table.material = "walnut", table.shape = Box{{0.9, 0.3, 0.03}};
  table.position = {0, 0, -0.015};
  die.name = "die", die.material = "resin", die.mass = 0.03, die.shape = Box{{kSide, kSide, kSide}};
  die.position = {-0.36, 0, 0.25};
  die.orientation = Quat(0.2618, -0.5164, -0.4103, -0.7046).normalized();
  die.velocity = {1, 0.05, 0.3}, die.angular_velocity = {-6, 10, -5};
  scene.bodies = {table, die};
  return scene;
}

}  // namespace

int main() {
  const Scene scene = dieAndTable();
  OdeContacts contacts(scene);
  const Vec3 faces[] = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  for (int pips = 1; pips <= 6; ++pips) {
    const Vec3 middle = 0.5 * kSide * faces[pips - 1];  // of the face, in the axes of the die
    Edit edit(scene, contacts, 0.75);
    edit.vary(velocity("die"), angularVelocity("die").weighted(0.5));
    // The middle of the face is 2 mm above the table at the most: the face points down, tilted by a few degrees.
    edit.nail("die", nthImpact(3, "table")).point(middle, any, any, within(0.001, 0.002));
    const EditResult result = edit.solve();
    const BodyState die = result.motion.stateBefore(*result.motion.findImpact(1, 3), 1);
    const double cosine = -(die.orientation * faces[pips - 1]).z();
    std::printf("%d down: %s, tilted by less than 10 degrees: %s, error below 1e-9: %s\n", pips,
                result.solved() ? "solved" : "not solved", cosine > 0.985 ? "yes" : "no",
                result.residual < 1e-9 ? "yes" : "no");
  }
}
