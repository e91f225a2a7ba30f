// SPDX-License-Identifier: MIT
#include "tests/cli/short_session.h"

#include <limits>

#include "ode_bridge/ode_contacts.h"

namespace carom::test {

namespace {

Scene thrownBall() {
  Scene scene;
  scene.materials.push_back({.name = "court", .elasticity = 0.7, .friction = 0.4});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "court", floor.shape = Plane{};
  ball.name = "ball", ball.material = "court", ball.shape = Sphere{0.033}, ball.mass = 0.057;
  ball.position = {0, 0, 1}, ball.velocity = {3, 0, 2};
  scene.bodies = {floor, ball};
  return scene;
}

SessionOptions withoutClock() {
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  return options;
}

}  // namespace

SessionJournal shortSession() {
  const Scene scene = thrownBall();
  OdeContacts contacts(scene);
  const SessionOptions options = withoutClock();
  EditSession session(scene, contacts, 2, options);
  session.vary(velocity("ball"), elasticity("court"));
  session.grab("ball", 1.5);
  session.dragTo(session.grabbedPlace() + Vec3(0.2, 0.1, 0.05));
  session.release();
  return session.journal();
}

SessionJournal studioSession() {
  const Scene scene = thrownBall();
  OdeContacts contacts(scene);
  SessionOptions options = withoutClock();
  options.unmet_nails_off = true;
  const Constraint goal = nailConstraint("ball", 0.2, {.position = WantedVector(0.7, any, any)});
  EditSession session(scene, contacts, 1, {}, {goal}, options);
  session.meetNails();
  session.grab("ball", 0.3, {}, {velocity("ball")});
  session.dragTo(session.grabbedPlace() + Vec3(0.2, 0.1, 0.05));
  session.dwell();
  session.releaseNailed(NailAt::where_it_got);
  session.grabNail({1});
  session.dragTo(session.grabbedPlace() + Vec3(0, 0, 0.1));
  session.release();
  session.setNailOn({0}, false);
  SessionContent content = session.content();
  content.scene.bodies[1].mass = 0.1;
  session.setContent(content, "a heavier ball");
  session.setNail({0}, nailConstraint("ball", 0.1, {.velocity = WantedVector(any, any, 1)}));
  session.undo();
  return session.journal();
}

}  // namespace carom::test
