// SPDX-License-Identifier: MIT
// Plays the scenes of the gallery, which have shapes of every kind, and tells how each begins and ends.
#include <cstdio>
#include <string>

#include "adjoint/simulate/simulate.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  for (const char* name : {"hat", "mug", "dice", "bowling", "ball_in_cup"}) {
    const Document document = readDocument(projectFile("examples/scenes/") + name + ".json");
    OdeContacts contacts(document.scene);
    const Motion motion = simulate(document.scene, contacts, document.duration);
    std::printf("%s: %s after %.2f s\n", name, nameOf(motion.status), motion.end);
    for (int i = 0; i < 3 && i < static_cast<int>(motion.events.size()); ++i)
      std::printf("  %.6f s: %s\n", motion.events[static_cast<std::size_t>(i)].time, motion.describeEvent(i).c_str());
  }
}
