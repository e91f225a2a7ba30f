// SPDX-License-Identifier: MIT
// What a window over a session shows and does: goals that begin off, a drag out of reach, why and what would help, a hand
// that rests, nails that are moved, and numbers that were typed.
#include <cstdio>
#include <string>

#include "editing/session.h"
#include "editing/session_alternatives.h"
#include "editing/session_remedies.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Scene throwOfABall() {
  Scene scene;
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  ball.name = "ball", ball.shape = Sphere{0.1}, ball.mass = 1;
  ball.position = {0, 0, 1}, ball.velocity = {2, 0, 3};
  scene.bodies = {floor, ball};
  return scene;
}

void tellNails(const EditSession& session) {
  for (const NailState& nail : session.nailStates())
    std::printf("  nail %d: %s, %s at %.3f s. %s\n", nail.id.value, nail.on ? "on" : "off", nail.met ? "met" : "not met",
                nail.time, nail.message.c_str());
}

}  // namespace

int main() {
  const Scene scene = throwOfABall();
  OdeContacts contacts(scene);
  SessionOptions options;
  options.unmet_nails_off = true;                       // nothing moves by itself
  options.drag_seconds = options.release_seconds = 60;  // so that no clock ends an update, however slow the machine
  const NailTargets targets{.position = WantedVector(1.2, any, any)};
  const Constraint goal = nailConstraint("ball", 0.5, targets);
  EditSession session(scene, contacts, 1, {velocity("ball").within(-3, 3)}, {goal}, options);
  std::printf("opened:\n");
  tellNails(session);
  session.meetNails();
  std::printf("%s:\n", session.undoName().c_str());
  tellNails(session);
  session.setNailOn(session.nails().front(), false);

  session.grab("ball", 0.5);
  SessionUpdate update = session.dragTo({9, 0, 1.2});
  update = session.dwell({}, [](const SessionUpdate& better) { static_cast<void>(better.motion); });  // to be drawn
  const SessionObstacle& obstacle = update.obstacle;
  std::printf("%.2f m from its target (%s). %s\n", update.distance, nameOf(obstacle.kind), obstacle.sentence.c_str());
  session.releaseNailed(NailAt::where_it_got);
  tellNails(session);
  // in another thread, with a contact source of its own: what would help, and other motions that meet the same
  const SessionSnapshot asked = session.snapshot();
  OdeContacts own(asked.content.scene);
  const SessionWhyNot why = whyNot(asked, own);
  for (const SessionRemedy& remedy : why.remedies)
    std::printf("%s (%s): %s\n", remedy.name.c_str(), nameOf(remedy.kind), remedy.solves ? "reaches it" : "not enough alone");
  const SessionAlternatives others = alternativesTo(asked, own, 6);
  std::printf("%zu others. %s\n", others.found.size(), others.message.c_str());

  const NailId nail = session.nails().back();
  session.grabNail(nail);
  session.dragTo({1, 0, 1.5});
  session.release();
  const double nailed_at = session.constraintOf(nail).targets[0].value[0];
  std::printf("the nail is at x %.2f m\n", nailed_at);

  // its spin may vary as well, but only where nothing else moved the ball
  session.grab("ball", 0.5, {}, {angularVelocity("ball")}, AlsoVary::where_nothing_moves_it);
  session.cancel();

  SessionContent content = session.content();
  content.scene.bodies[1].velocity.x() = 2.5;
  session.setContent(content, "velocity of the ball");
  std::printf("after a number was typed:\n");
  tellNails(session);
  for (const SessionNumber& number : session.numbers())
    std::printf("  %s: %.2f, from %g to %g\n", number.name.c_str(), number.value, number.min, number.max);
  // it goes on elsewhere, or later, with all its steps
  const SessionHistory history = session.history();
  const SessionHistoryPoint& first = history.past.front();
  for (const SessionHistoryNail& held : first.nails) static_cast<void>(held.on);
  EditSession again(history, contacts);
  while (session.canUndo()) {
    std::printf("undo %s\n", session.undoName().c_str());
    session.undo();
  }
}
