// SPDX-License-Identifier: MIT
// A ball rolls off a table and falls beside the cup on the floor. The throw is changed so that it falls in: the goals
// lie after it slid, rolled, and left the edge.
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

Scene tableAndCup() {
  Scene scene;
  scene.materials.push_back({.name = "beech", .elasticity = 0.4, .friction = 0.3});
  scene.materials.push_back({.name = "felt", .elasticity = 0.1, .friction = 0.5});
  Body floor, table, cup, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "beech", floor.shape = Plane{};
  table.name = "table", table.fixed = true, table.material = "beech", table.shape = Box{{1.2, 0.8, 0.04}};
  table.position = {0, 0, 0.73};
  cup.name = "cup", cup.fixed = true, cup.material = "felt", cup.position = {1.1, 0.1, 0};
  cup.shape = Compound{{board({0.16, 0.16, 0.006}, {0, 0, 0.003}), board({0.006, 0.172, 0.1}, {-0.083, 0, 0.05}),
                        board({0.006, 0.172, 0.1}, {0.083, 0, 0.05}), board({0.16, 0.006, 0.1}, {0, -0.083, 0.05}),
                        board({0.16, 0.006, 0.1}, {0, 0.083, 0.05})}};
  ball.name = "ball", ball.material = "beech", ball.mass = 0.045, ball.shape = Sphere{0.025};
  ball.position = {-0.4, -0.1, 0.775}, ball.velocity = {1.5, 0.05, 0};
  scene.bodies = {floor, table, cup, ball};
  return scene;
}

double tidy(double x) { return std::abs(x) < 1e-6 ? 0 : x; }  // prints no "-0.000"

}  // namespace

int main() {
  const Scene scene = tableAndCup();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.4);
  edit.vary(velocity("ball").only({"x", "y"}));

  // At some moment it is in the middle of the opening; at the end it is in the cup, all of it.
  edit.nail("ball", between(0.8, 1.3)).position({1.1, 0.1, 0.125});
  Region in_cup;
  in_cup.shape = Box{{0.172, 0.172, 0.1}}, in_cup.position = {1.1, 0.1, 0.05}, in_cup.during = {{1.3, 1.4}};
  edit.nail("ball", 0.0).inside(in_cup);

  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    std::printf("  %-20s %6.3f -> %6.3f\n", number.name.c_str(), number.before, tidy(number.after));
  const double over_cup = result.times.at(0).time;
  const std::vector<Arc>& arcs = result.motion.world_lines[3].arcs;
  for (int k = result.motion.arcAt(3, 0); k <= result.motion.arcAt(3, over_cup); ++k) {
    const Arc& arc = arcs[static_cast<std::size_t>(k)];
    std::printf("  %.3f s: %s\n", arc.start(), nameOf(arc.kind()));
  }
  std::printf("  %.3f s: in the opening\n", over_cup);
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
  return result.solved() ? 0 : 1;
}
