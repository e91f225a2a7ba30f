// SPDX-License-Identifier: MIT
// A ball is thrown through a ring and then strikes a net at a given angle: the ring is a nail, and the angle a
// function of the motion that carom does not know, with its derivative.
#include <cmath>
#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

Scene ballAndNet() {
  Scene scene;
  scene.materials.push_back({.name = "leather", .elasticity = 0.7, .friction = 0.4});
  Body floor, net, ball;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  net.name = "net", net.fixed = true, net.shape = Plane{{-1, 0, 0}, -4};  // stands at x = 4
  ball.name = "ball", ball.material = "leather", ball.mass = 0.6, ball.shape = Sphere{0.12};
  ball.position = {0, 0, 1.6}, ball.velocity = {4, 0.2, 4};
  scene.bodies = {floor, net, ball};
  return scene;
}

// The angle between the velocity v and the normal n of the net just before the impact: tan a = |v_t|/|v.n| with v_t the
// part of v along the net; da = (|v.n| d|v_t| - |v_t| d|v.n|)/|v|^2. Its second derivatives are left to the search.
RowReading angleAtNet(const Motion& motion) {
  const int ball = bodyIndex(*motion.scene, "ball"), net = bodyIndex(*motion.scene, "net");
  const int event = motion.findImpact(ball, 1, net).value();  // there is one, see `until` below
  const Vec3 n(-1, 0, 0), v = motion.stateBefore(event, ball).velocity;
  const double across = -v.dot(n), along = (v - v.dot(n) * n).norm();
  RowReading reading;
  reading.value = std::atan2(along, across);
  StateSeed& seed = reading.seeds.emplace_back();
  seed.body = ball;
  seed.at = Instant::before(event);
  seed.velocity = (across * (v - v.dot(n) * n) / along + along * n) / v.squaredNorm();
  return reading;
}

}  // namespace

int main() {
  const Scene scene = ballAndNet();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1.5);
  edit.vary(velocity("ball"));
  edit.nail("ball", between(0.3, 0.8)).position({2.5, 0.1, 2.6});

  MotionFunction angle;
  angle.name = "angle at the net";
  angle.read = angleAtNet;
  angle.until = nthImpact(1, "net");  // what comes after it does not matter
  angle.body = "ball";
  edit.require(angle, 40 / kDegrees);

  const EditResult result = edit.solve();
  std::printf("%s, largest error below 1e-9: %s\n", nameOf(result.status), result.scaled_residual < 1e-9 ? "yes" : "no");
  std::printf("through the ring at %.4f s\n", result.times[0].time);
  std::printf("angle at the net %.4f degrees, at first %.4f\n", angleAtNet(result.motion).value * kDegrees,
              angleAtNet(simulate(scene, contacts, 1.5)).value * kDegrees);
  for (const ChangedNumber& number : result.changed)
    std::printf("%-24s %8.4f -> %8.4f\n", number.name.c_str(), number.before, number.after);
}
