// SPDX-License-Identifier: MIT
// A session with a nail and a drag, its journal as text, and the journal played again to the same bits.
#include <cmath>
#include <cstdio>

#include "editing/session_numbers.h"
#include "editing/session_replay.h"
#include "formats/documents/journal_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  Scene scene;
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  ball.name = "ball", ball.shape = Sphere{0.1}, ball.mass = 1;
  ball.position = {0, 0, 1}, ball.velocity = {2, 0, 3};
  scene.bodies = {floor, ball};
  OdeContacts contacts(scene);

  SessionOptions options;
  options.measure_from = MeasureFrom::start;  // drags do not add up
  options.drag_seconds = options.release_seconds =
      Seconds(60);  // so that no clock ends an update, however slow the machine
  EditSession session(scene, contacts, 1, options);
  session.vary(velocity("ball"), position("ball"));
  const NailId start = session.nail("ball", 0.0, {.position = Vec3(0, 0, 1)});
  std::printf("nail %d holds where the throw begins\n", start.value);

  Grip grip;
  grip.components = {"x", "z"};
  session.grab("ball", 0.4, grip);
  session.dragTo({1, 0, 1.5});
  const SessionUpdate update = session.release();
  std::printf("the drag ended %s; the target is reached: %s\n",
              update.stage == SessionStage::solved ? "solved" : nameOf(update.stage), update.reached ? "yes" : "no");
  for (const SessionNumber& number : sessionNumbers(session.scene(), session.controls()))
    std::printf("%-24s %8.4f\n", number.name.c_str(), std::abs(number.value) < 1e-9 ? 0 : number.value);

  JournalDocument document;
  document.journal = session.journal();
  document.name = "one drag";
  const JournalDocument read = parseJournal(writeJournal(document), "journal");
  const SessionJournal& journal = read.journal;
  for (const SessionGesture& gesture : journal.gestures) {
    std::printf("%s", nameOf(gesture.kind));
    for (const DragTarget& target : gesture.targets)
      std::printf(" to (%g, %g, %g)", target.place.x(), target.place.y(), target.place.z());
    std::printf("\n");
  }
  SessionReplay replay(journal, contacts);
  bool same = true;
  while (!replay.done()) {
    const ReplayedGesture played = replay.next();
    same = same && played.differences.empty();
  }
  std::printf("played again to the same bits: %s\n", same ? "yes" : "no");
}
