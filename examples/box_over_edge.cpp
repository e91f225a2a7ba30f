// SPDX-License-Identifier: MIT
// A box slides over the edge of a table, tips and falls: how fast must it be to strike the floor at a place? Then: why it
// went on otherwise on the way.
#include <cstdio>

#include "editing/edit.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  const Document document = readDocument(projectFile("examples/scenes/box-over-edge.json"));
  OdeContacts contacts(document.scene);
  Edit edit(document.scene, contacts, document.duration, document.controls, document.constraints);
  const EditResult result = edit.solve();
  std::printf("%s, largest error below 1e-9: %s\n", nameOf(result.status), result.residual < 1e-9 ? "yes" : "no");
  for (const ChangedNumber& number : result.changed)
    std::printf("  %s: %.3f -> %.3f\n", number.name.c_str(), number.before, number.after);

  for (const Event& event : result.motion.events) {
    if (event.kind == EventKind::transition)
      std::printf("  %.3f s: %s, %zu contacts\n", event.time, nameOf(event.cause), event.contacts.size());
    if (event.kind == EventKind::impact) {
      std::printf("  %.3f s: an impact\n", event.time);
      break;
    }
  }
  return result.solved() ? 0 : 1;
}
