// SPDX-License-Identifier: MIT
// Finds the throw that lands a ball at a place with its second bounce, and what the floor's elasticity has to be.
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  Scene scene;
  scene.materials.push_back({.name = "court", .elasticity = 0.7, .friction = 0.4});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "court", floor.shape = Plane{};
  ball.name = "ball", ball.material = "court", ball.shape = Sphere{0.033}, ball.mass = 0.057;
  ball.position = {0, 0, 1};
  ball.velocity = {3, 0, 2};
  ball.angular_velocity = {0, 20, 0};
  scene.bodies = {floor, ball};

  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2.5);
  edit.vary(velocity("ball"), elasticity("court").within(0.5, 0.9));
  edit.nail("ball", nthImpact(2)).position({5, 0.5, any}).time(1.5);  // a nail holds until it is removed
  const EditResult result = edit.solve();

  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    std::printf("%-24s %9.5f -> %9.5f\n", number.name.c_str(), number.before, number.after);
  for (const ConstrainedNumber& number : result.residuals)
    std::printf("%-40s %9.5f (wanted %.5f)\n", number.name.c_str(), number.value, number.target);
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
}
