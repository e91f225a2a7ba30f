// SPDX-License-Identifier: MIT
// Fitting a recording: noisy places of a ball as soft constraints, and what they tell of its throw and its elasticity.
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  Scene scene;
  scene.materials = {{.name = "rubber", .elasticity = 0.6, .friction = 0}};
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "rubber", floor.shape = Plane{};
  ball.name = "ball", ball.material = "rubber", ball.shape = Sphere{0.03}, ball.mass = 0.06;
  ball.position = {0, 0, 1}, ball.velocity = {1, 0, 0};
  scene.bodies = {floor, ball};

  struct Sample {
    double time, x, z;
  };
  const Sample recording[] = {{0.15, 0.1952, 0.8921}, {0.30, 0.3881, 0.5605}, {0.45, 0.5845, 0.0460}, {0.60, 0.7838, 0.3998},
                              {0.75, 0.9749, 0.5332}, {0.90, 1.1723, 0.4432}, {1.05, 1.3662, 0.1322}, {1.20, 1.5593, 0.2243},
                              {1.35, 1.7523, 0.2819}, {1.50, 1.9467, 0.1234}};
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.5);
  edit.vary(velocity("ball").only({"x"}).weighted(0.01), elasticity("rubber").weighted(0.01));
  for (const Sample& sample : recording) edit.nail("ball", sample.time).position(sample.x, any, sample.z).soft();

  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    if (number.standard_deviation)
      std::printf("%-22s %.4f +- %.4f\n", number.name.c_str(), number.after, *number.standard_deviation);
  const Fit& fit = result.fit;
  std::printf("%d errors, %d parameters", fit.rows, fit.parameters);
  if (fit.deviation) std::printf(", one error %.2f mm", *fit.deviation * 0.06 * 1000);  // 0.06 m: the natural length
  std::printf("\n%s", fit.message.c_str());
  return result.solved() ? 0 : 1;
}
