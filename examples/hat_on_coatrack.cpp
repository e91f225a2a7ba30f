// SPDX-License-Identifier: MIT
// A hat is thrown onto a coatrack. A nail holds how it lands; then the spin is changed, and the throw follows: the more
// spin, the flatter and faster it gets.
#include <cstdio>
#include <string>

#include "editing/edit.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  const Document document = readDocument(projectFile("examples/scenes/hat-on-coatrack.json"));
  OdeContacts contacts(document.scene);
  Edit edit(document.scene, contacts, document.duration);
  edit.vary(velocity("hat"), angularVelocity("hat").weighted(0.2));

  // The pose just before the hat meets the coatrack, whenever that is. x is left free: there the two touch.
  const Quat tilted(0.930507, 0, -0.366273, 0);
  edit.nail("hat", nthImpact(1, "coatrack")).position({any, 0, 1.545}).orientation(tilted.normalized());

  for (const double spin : {7.5, 8.0, 9.0}) {
    const Nail faster = edit.nail("hat", 0.0).angularVelocity({any, spin, any});  // rad/s at the start, about y
    const EditResult result = edit.solve();
    edit.unnail(faster);

    const Vec3 v = result.scene.bodies[static_cast<std::size_t>(bodyIndex(result.scene, "hat"))].velocity;
    const int landing = *result.motion.findImpact(bodyIndex(result.scene, "hat"), 1);
    std::printf(
        "spin %4.1f: %s, thrown with %.3f m/s forward and %.3f m/s up, lands after %.3f s, error below 1e-9: %s\n",
        spin, nameOf(result.status), v.x(), v.z(), result.motion.events[static_cast<std::size_t>(landing)].time,
        result.residual < 1e-9 ? "yes" : "no");
  }

  // The landing fixes how far the hat turns, so the spin and the time of flight cannot both be chosen.
  edit.nail("hat", 0.0).angularVelocity({any, 9, any});
  edit.nail("hat", nthImpact(1, "coatrack")).time(0.6);
  EditOptions options;
  options.sequence = SequencePolicy::stay;  // no other impacts are looked for
  const EditResult result = edit.solve(options);
  std::printf("spin 9.0 and 0.6 s: %s\n", result.solved() ? "solved" : "not solved");
  for (const WhyNot::Conflict& conflict : result.why_not.conflicts)
    for (const std::string& name : conflict.names) std::printf("  stands in the way: %s\n", name.c_str());
}
