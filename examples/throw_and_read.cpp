// SPDX-License-Identifier: MIT
// Throws a spinning brick onto the floor and reads its motion: impacts, and the state at any time.
#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  Scene scene;
  scene.materials.push_back({.name = "wood", .elasticity = 0.8, .friction = 0.3});

  Body floor;
  floor.name = "floor";
  floor.fixed = true;
  floor.material = "wood";
  floor.shape = Plane{};

  Body brick;
  brick.name = "brick";
  brick.material = "wood";
  brick.shape = Box{{0.3, 0.2, 0.1}};
  brick.mass = 0.4;
  brick.position = {0, 0, 1};
  brick.velocity = {1.5, 0, 0};
  brick.angular_velocity = {3, -2, 4};
  scene.bodies = {floor, brick};

  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.8);
  std::printf("%s, %zu impacts\n", nameOf(motion.status), motion.events.size());
  for (std::size_t i = 0; i < motion.events.size(); ++i)
    std::printf("%.6f s: %s\n", motion.events[i].time, motion.describeEvent(static_cast<int>(i)).c_str());
  for (const double t : {0.0, 0.4, 0.8}) {
    const BodyState s = motion.stateAt("brick", t);
    std::printf("t = %.1f s: at (%.6f, %.6f, %.6f) m, spinning at %.6f rad/s\n", t, s.position.x(), s.position.y(),
                s.position.z(), s.angular_velocity.norm());
  }
}
