// SPDX-License-Identifier: MIT
// A rod that stands on the rim of its end falls over. Its foot holds, then slips: which friction makes it come to lie at
// a place?
#include <cstdio>

#include "editing/edit.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  const Document document = readDocument(projectFile("examples/scenes/falling-rod.json"));
  OdeContacts contacts(document.scene);
  Edit edit(document.scene, contacts, document.duration, document.controls, document.constraints);
  const EditResult result = edit.solve();
  std::printf("%s, largest error below 1e-9: %s\n", nameOf(result.status), result.residual < 1e-9 ? "yes" : "no");
  for (const ChangedNumber& number : result.changed)
    std::printf("  %s: %.4f -> %.4f\n", number.name.c_str(), number.before, number.after);

  const int rod = bodyIndex(*result.motion.scene, "rod");
  for (const Arc& arc : result.motion.world_lines[static_cast<std::size_t>(rod)].arcs)
    if (arc.kind() != ArcKind::flight) std::printf("  %.3f s: %s\n", arc.start(), nameOf(arc.kind()));
  return result.solved() ? 0 : 1;
}
