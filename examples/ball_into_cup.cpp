// SPDX-License-Identifier: MIT
// A ball bounces on the table and misses a cup made of five boxes. Two nails without a given time bring it in.
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

Scene ballAndCup() {
  Scene scene;
  scene.materials.push_back({.name = "celluloid", .elasticity = 0.85, .friction = 0.25});
  scene.materials.push_back({.name = "beech", .elasticity = 0.8, .friction = 0.4});
  scene.materials.push_back({.name = "felt", .elasticity = 0.1, .friction = 0.5});
  Body table, cup, ball;
  table.name = "table", table.fixed = true, table.material = "beech", table.shape = Box{{1.9, 0.6, 0.04}};
  table.position = {0, 0, -0.02};
  cup.name = "cup", cup.fixed = true, cup.material = "felt", cup.position = {0.55, 0, 0};
  cup.shape = Compound{{board({0.16, 0.16, 0.006}, {0, 0, 0.003}), board({0.006, 0.172, 0.1}, {-0.083, 0, 0.05}),
                        board({0.006, 0.172, 0.1}, {0.083, 0, 0.05}), board({0.16, 0.006, 0.1}, {0, -0.083, 0.05}),
                        board({0.16, 0.006, 0.1}, {0, 0.083, 0.05})}};
  ball.name = "ball", ball.material = "celluloid", ball.mass = 0.0027;
  ball.shape = Sphere{0.02};
  ball.position = {-0.75, -0.08, 0.25}, ball.velocity = {1.5, 0.25, 0.9}, ball.angular_velocity = {0, 40, 0};
  scene.bodies = {table, cup, ball};
  return scene;
}

double tidy(double x) { return std::abs(x) < 1e-6 ? 0 : x; }  // prints no "-0.000"

}  // namespace

int main() {
  const Scene scene = ballAndCup();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.15);
  edit.vary(velocity("ball"), angularVelocity("ball").weighted(0.5));

  // At some moment the ball is above the opening and on its way down.
  edit.nail("ball", between(0.6, 1.1)).position({0.52, 0, 0.13}).velocity(any, any, atMost(-0.5));
  // At the end it is in the cup, all of it.
  Region in_cup;
  in_cup.shape = Box{{0.172, 0.172, 0.1}}, in_cup.position = {0.55, 0, 0.05}, in_cup.during = TimeSpan(1.1, 1.15);
  edit.nail("ball", 0.0).inside(in_cup);

  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    std::printf("  %-28s %8.3f -> %8.3f\n", number.name.c_str(), number.before, tidy(number.after));
  for (const ConstrainedNumber& number : result.residuals)
    std::printf("  %-50s %8.4f (%.4f to %.4f)\n", number.name.c_str(), tidy(number.value), number.lower, number.upper);
  for (const MetTime& met : result.times) std::printf("  %s: at %.3f s\n", met.name.c_str(), met.time);
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
}
