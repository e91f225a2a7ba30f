// SPDX-License-Identifier: MIT
// A ball drops onto a table, slides, rolls, and falls off: which paths it takes, how its contact moves, what happens in
// between, and how the place where it lands varies with the throw.
#include <cstdio>

#include "adjoint/derivative/settling.h"
#include "adjoint/motion/lasting_contact.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

// The contact goes with the ball, at the speed of its centre; the point of the ball that is there slips, or stands.
void printContactHalfWay(const Motion& motion, const LastingContact& c) {
  const BodyState ball = motion.stateAt(c.body, 0.5 * (c.from + c.to)), table = motion.stateAt(c.with, 0.5 * (c.from + c.to));
  const auto poseOf = [](const BodyState& s) { return Pose{s.position, s.orientation.toRotationMatrix()}; };
  const PoseRate rate{ball.velocity, ball.angular_velocity};
  const ContactMotion at = motion.geometry->motion(c.body, c.with, c.features[0], poseOf(ball), poseOf(table), rate, {});
  const Vec3 slip = rate.v + rate.w.cross(at.at.point - ball.position);
  std::printf("half-way the contact moves at %.9f m/s, slip %.9f m/s\n", at.point_rate.norm(), slip.norm());
}

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

  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1.3);
  std::printf("%s\n", motion.message.c_str());
  std::printf("%zu impacts among %zu events\n", motion.impacts, motion.event_count);
  for (int e = 0; e < static_cast<int>(motion.events.size()); ++e) {
    const Event& event = motion.events[static_cast<std::size_t>(e)];
    if (event.kind == EventKind::impact && !event.counts()) continue;  // lower than a millionth of the ball
    std::printf("%.9f s: %s, %s", event.time, nameOf(event.kind), motion.describeEvent(e).c_str());
    if (event.kind == EventKind::transition && event.cause == TransitionCause::slip_ends) std::printf(", as slip ends");
    if (event.settles_at) std::printf("; endless bounces would have ended at %.9f s", *event.settles_at);
    std::printf("\n");
  }
  const auto name = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].name.c_str(); };
  for (const LastingContact& c : lastingContacts(motion)) {
    std::printf("%s %s on %s from %.9f s to %.9f s\n", name(c.body), c.kind == ArcKind::roll ? "rolls" : "slides",
                name(c.with), c.from, c.to);
    printContactHalfWay(motion, c);
  }

  DerivativeTape tape(motion);
  for (int e = 0; e < static_cast<int>(motion.events.size()); ++e)
    if (motion.events[static_cast<std::size_t>(e)].settles_at)
      std::printf("d(when it settles)/d(elasticity) %.9f s\n", settlesAtGradient(tape, e).materials[0].elasticity);

  StateSeed place;
  place.body = 0;
  place.at = Instant::before(*motion.findImpact(0, 1, 2));
  place.position = Vec3::UnitX();
  const SceneGradient gradient = adjoint(tape, {&place, 1});
  std::printf("lands at x = %.9f m; dx/d(speed) %.9f s\n",
              motion.stateBefore(place.at.event, 0).position.x(), gradient.bodies[0].velocity.x());
}
