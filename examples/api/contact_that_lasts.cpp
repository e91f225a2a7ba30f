// SPDX-License-Identifier: MIT
// A ball drops onto a table, slides, rolls, and falls off: which paths it takes, what happens in between, and how the
// place where it lands varies with the throw.
#include <cstdio>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  Scene scene;
  scene.gravity = {0, 0, -9.81};
  scene.materials.resize(1);
  scene.materials[0].name = "wood", scene.materials[0].elasticity = 0.2, scene.materials[0].friction = 0.2;
  Body ball, table, floor;
  ball.name = "ball", ball.shape = Sphere{0.05}, ball.mass = 0.5, ball.position = {0, 0, 0.15};
  ball.velocity = {1.7, 0, 0};
  table.name = "table", table.fixed = true, table.shape = Box{{2, 2, 0.75}}, table.position = {0, 0, -0.375};
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{}, floor.position = {0, 0, -0.75};
  scene.bodies = {ball, table, floor};
  for (Body& body : scene.bodies) body.material = "wood";

  SimulateOptions options;
  options.lowest_bounce = 1e-12;  // m
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1.3, options);
  std::printf("%s\n", motion.message.c_str());
  ArcKind before = ArcKind::flight;
  for (const Event& event : motion.events) {
    const Participant* participant = event.find(0);
    const Arc& arc = motion.world_lines[0].arcs[static_cast<std::size_t>(participant->arc) + 1];
    if (event.kind == EventKind::transition)
      std::printf("%.9f s: %s\n", event.time, event.cause == TransitionCause::leaves ? "leaves the table"
                                                                                      : nameOf(event.cause));
    if (event.settles_at) std::printf("%.9f s: endless bounces would have ended\n", *event.settles_at);
    if (arc.kind() != before) std::printf("%.9f s: %s\n", event.time, nameOf(before = arc.kind()));
  }

  StateSeed place;
  place.body = 0;
  place.at = Instant::before(*motion.findImpact(0, 1, 2));
  place.position = Vec3::UnitX();
  const SceneGradient gradient = adjoint(motion, {&place, 1});
  std::printf("lands at x = %.9f m; dx/d(speed) %.9f s\n",
              motion.stateBefore(place.at.event, 0).position.x(), gradient.bodies[0].velocity.x());
}
