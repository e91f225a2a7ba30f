// SPDX-License-Identifier: MIT
// A die is to come to rest with a chosen face up: which throw? Then the throw is simulated afresh.
#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

/// How far the chosen face, -z in the axes of the die, points up in the end: 1 is up.
double upAtTheEnd(const Motion& motion) {
  return (motion.stateAt("die", motion.end).orientation * Vec3(0, 0, -1)).z();
}

}  // namespace

int main() {
  const Document document = readDocument(projectFile("examples/scenes/die-at-rest.json"));
  OdeContacts contacts(document.scene);
  std::printf("as written: up %.6f\n", upAtTheEnd(simulate(document.scene, contacts, document.duration)));

  const Edit edit(document.scene, contacts, document.duration, document.controls, document.constraints);
  EditOptions options;
  options.effort = Effort::fast;  // any throw that is met; a smaller change takes longer to find
  const EditResult result = edit.solve(options);
  std::printf("met: %s, largest error below 1e-9: %s\n", result.met ? "yes" : "no", result.residual < 1e-9 ? "yes" : "no");

  OdeContacts afresh(result.scene);
  const Motion motion = simulate(result.scene, afresh, document.duration);
  std::printf("as edited: up %.6f, %s to the end\n", upAtTheEnd(motion), nameOf(motion.world_lines[1].arcs.back().kind()));
  return result.solved() ? 0 : 1;
}
