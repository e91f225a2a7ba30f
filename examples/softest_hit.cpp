// SPDX-License-Identifier: MIT
// A ball shall strike a mark on a wall, with the least speed with which it can: an objective of one's own in place of the
// smallest change. Without air the least speed at the mark belongs to the least speed of the throw,
// v^2 = g (h + sqrt(h^2 + d^2)) for a mark h above and d away.
#include <cmath>
#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Scene ballAndWall() {
  Scene scene;
  Body floor, wall, ball;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  wall.name = "wall", wall.fixed = true, wall.shape = Plane{{-1, 0, 0}, -3.1};  // the ball is at x = 3 when they touch
  ball.name = "ball", ball.mass = 0.4, ball.shape = Sphere{0.1};
  ball.position = {0, 0, 1}, ball.velocity = {7, 0.3, 3};
  scene.bodies = {floor, wall, ball};
  return scene;
}

// Half the square of the speed just before the first impact: d(1/2 v.v) = v.dv, and the weight v changes by dv.
RowReading hardness(const Motion& motion) {
  const int ball = bodyIndex(*motion.scene, "ball");
  const int event = motion.findImpact(ball, 1).value();
  const Vec3 v = motion.stateBefore(event, ball).velocity;
  RowReading reading;
  reading.value = 0.5 * v.squaredNorm();
  StateSeed& seed = reading.seeds.emplace_back();
  seed.body = ball;
  seed.at = Instant::before(event);
  seed.velocity = v;
  reading.second_order = true;
  reading.seed_rates = [](std::span<const BodyStateRate> rates) {
    StateSeed weights;
    weights.velocity = rates[0].velocity;
    return std::vector<StateSeed>{weights};
  };
  return reading;
}

}  // namespace

int main() {
  const Scene scene = ballAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("ball"));
  edit.nail("ball", nthImpact(1, "wall")).position({any, 0.2, 1.5});

  MotionFunction objective;
  objective.name = "hardness of the hit";
  objective.read = hardness;
  objective.until = nthImpact(1);
  objective.body = "ball";
  edit.minimise(objective);

  const EditResult result = edit.solve();
  const double g = 9.81, h = 0.5, d2 = 3 * 3 + 0.2 * 0.2;
  const double least = g * (h + std::sqrt(h * h + d2)) - 2 * g * h;  // at the mark, squared
  const double found = 2 * hardness(result.motion).value;
  std::printf("%s, largest error below 1e-9: %s\n", nameOf(result.status), result.scaled_residual < 1e-9 ? "yes" : "no");
  std::printf("speed at the mark %.6f m/s, least possible %.6f, at first %.6f\n", std::sqrt(found), std::sqrt(least),
              std::sqrt(2 * hardness(simulate(scene, contacts, 2)).value));
  for (const ChangedNumber& number : result.changed)
    std::printf("%-24s %8.4f -> %8.4f\n", number.name.c_str(), number.before, number.after);
}
