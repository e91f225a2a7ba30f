// SPDX-License-Identifier: MIT
// A coin rolls on its rim, in the bend that it leans into: which throw brings it to a place? Then: what a little more
// spin about the vertical would do there.
#include <cstdio>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/motion/lasting_contact.h"
#include "editing/edit.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  const Document document = readDocument(projectFile("examples/scenes/coin.json"));
  OdeContacts contacts(document.scene);
  Edit edit(document.scene, contacts, document.duration, document.controls, document.constraints);
  const EditResult result = edit.solve();
  std::printf("%s\n", nameOf(result.status));
  for (const ChangedNumber& number : result.changed)
    std::printf("  %-24s %6.3f -> %6.3f\n", number.name.c_str(), number.before, number.after);
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");

  const Motion& motion = result.motion;
  for (std::size_t k = 0; k < motion.events.size(); ++k)
    std::printf("  %.3f s: %s\n", motion.events[k].time, describeChanges(motion, static_cast<int>(k)).c_str());
  StateSeed place;
  place.body = bodyIndex(*motion.scene, "coin"), place.at = Instant::at(0.8), place.position = Vec3::UnitX();
  const SceneGradient gradient = adjoint(motion, {&place, 1});
  std::printf("a tenth of a rad/s about the vertical moves it by %.2f mm along x\n",
              100 * gradient.bodies[1].angular_velocity.z());
  return result.solved() ? 0 : 1;
}
