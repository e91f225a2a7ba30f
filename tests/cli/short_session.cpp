// SPDX-License-Identifier: MIT
#include "tests/cli/short_session.h"

#include <limits>

#include "ode_bridge/ode_contacts.h"

namespace carom::test {

SessionJournal shortSession() {
  Scene scene;
  scene.materials.push_back({.name = "court", .elasticity = 0.7, .friction = 0.4});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "court", floor.shape = Plane{};
  ball.name = "ball", ball.material = "court", ball.shape = Sphere{0.033}, ball.mass = 0.057;
  ball.position = {0, 0, 1}, ball.velocity = {3, 0, 2};
  scene.bodies = {floor, ball};
  OdeContacts contacts(scene);
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  EditSession session(scene, contacts, 2, options);
  session.vary(velocity("ball"), elasticity("court"));
  session.grab("ball", 1.5);
  session.dragTo(session.grabbedPlace() + Vec3(0.2, 0.1, 0.05));
  session.release();
  return session.journal();
}

}  // namespace carom::test
