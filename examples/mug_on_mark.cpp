// SPDX-License-Identifier: MIT
// A session, as behind an editor's window: the third bounce of a mug is taken hold of and dragged over the table.
#include <cstdio>
#include <string>

#include "editing/session.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

const Vec3 kMiddle(0, 0, 0.0475);  // of the mug, in its axes

/// Where the middle of the mug is at its third bounce.
Vec3 thirdBounce(const Motion& motion) {
  const int mug = bodyIndex(*motion.scene, "mug"), table = bodyIndex(*motion.scene, "table");
  const BodyState state = motion.stateBefore(motion.findImpact(mug, 3, table).value(), mug);
  return state.position + state.orientation * kMiddle;
}

void tell(const char* what, const EditSession& session) {
  const Vec3 place = thirdBounce(session.motion());
  std::printf("%-8s third bounce at x %.4f, y %.4f; thrown with %.3f m/s forward\n", what, place.x(), place.y(),
              session.scene().bodies.back().velocity.x());
}

}  // namespace

int main() {
  const Document document = readDocument(projectFile("examples/scenes/mug-on-mark.json"));
  OdeContacts contacts(document.scene);
  EditSession session(document.scene, contacts, document.duration);
  session.vary(velocity("mug"), angularVelocity("mug").weighted(0.5));
  tell("start:", session);

  // Held by its middle, whenever the third bounce comes. The height stays free: there the mug touches the table.
  session.grab("mug", nthImpact(3, "table"), {.body_point = kMiddle, .components = {"x", "y"}});
  const Vec3 from = session.grabbedPlace(), mark(0.4, -0.05, from.z());
  for (int frame = 1; frame <= 20; ++frame)  // the mouse on its way; each call leaves a verified motion
    session.dragTo(from + frame / 20.0 * (mark - from));
  const SessionUpdate update = session.release();  // makes the change as small as it can be
  tell("dragged:", session);
  std::printf("         %s, %s\n", nameOf(update.stage), update.reached ? "on the mark" : "not on the mark");
  const double miss = (thirdBounce(session.motion()) - mark).head<2>().norm();

  session.undo();  // the whole gesture is one step
  tell("undone:", session);
  session.redo();
  tell("redone:", session);
  std::printf("largest error below 1e-9: %s\n", miss < 1e-9 ? "yes" : "no");
}
