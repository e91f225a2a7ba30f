// SPDX-License-Identifier: MIT
// A putt on a green that falls to the side, with a hole in it: aimed straight at the hole the ball slides, rolls, and
// misses it. The edit aims higher up: a firm putt borrows less than a soft one.
#include <cmath>
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

constexpr double kPi = 3.14159265358979324;
constexpr double kRadius = 0.0213, kHole = 0.108;  // m

CompoundPart turf(const Vec3& from, const Vec3& to) {
  CompoundPart part;
  part.shape = Box{to - from}, part.position = 0.5 * (from + to);
  return part;
}

// The axes are those of the green, which falls along y by five in two hundred.
Scene green() {
  Scene scene;
  scene.gravity = {0, 0.245, -9.807};
  scene.materials.push_back({.name = "grass", .elasticity = 0.3, .friction = 0.4});
  scene.materials.push_back({.name = "plastic", .elasticity = 0.3, .friction = 0.3});
  Body green, ball;
  green.name = "green", green.fixed = true, green.material = "grass";
  const double near = 3 - kHole / 2, far = 3 + kHole / 2, side = kHole / 2;
  green.shape = Compound{{turf({-0.3, -0.8, -0.12}, {near, 1.7, 0}), turf({far, -0.8, -0.12}, {4.6, 1.7, 0}),
                          turf({near, -0.8, -0.12}, {far, -side, 0}), turf({near, side, -0.12}, {far, 1.7, 0}),
                          turf({near, -side, -0.12}, {far, side, -0.1})}};
  ball.name = "ball", ball.material = "plastic", ball.mass = 0.046, ball.shape = Sphere{kRadius};
  ball.position = {0, 0, kRadius}, ball.velocity = {1.5, 0, 0};
  scene.bodies = {green, ball};
  return scene;
}

// `least`: how high the ball still is over the middle of the hole; the faster it comes, the less it has fallen.
void putt(const char* name, double least) {
  const Scene scene = green();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 4);
  edit.vary(velocity("ball").only({"x", "y"}));
  // At some moment it is over the middle of the hole, and falling.
  edit.nail("ball", between(2, 3.5)).position(3, 0, within(least, kRadius));

  const EditResult result = edit.solve();
  const Vec3 aim = result.scene.bodies[1].velocity;
  std::printf("%s: %s\n", name, nameOf(result.status));
  std::printf("  %.3f m/s, %.2f degrees above the hole\n", aim.norm(), -std::atan2(aim.y(), aim.x()) * 180 / kPi);
  const double over_hole = result.times.at(0).time;
  const std::vector<Arc>& arcs = result.motion.world_lines[1].arcs;
  for (int k = result.motion.arcAt(1, 0); k <= result.motion.arcAt(1, over_hole); ++k) {
    const Arc& arc = arcs[static_cast<std::size_t>(k)];
    std::printf("  %.3f s: %s\n", arc.start(), nameOf(arc.kind()));
  }
  std::printf("  %.3f s: over the hole\n", over_hole);
  const double end = result.motion.stateAt("ball", result.motion.end).position.z() - kRadius;
  std::printf("  at the end %.1f cm below the green\n", -100 * end);
  std::printf("  largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
}

}  // namespace

int main() {
  putt("soft", 0);
  putt("firm", 0.011);
}
