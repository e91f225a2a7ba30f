// SPDX-License-Identifier: MIT
// What a viewer needs: triangles once, and for every motion a track a body, from which it makes any pose itself.
#include <algorithm>
#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "formats/drawing/display.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

int main() {
  const Document document = readDocument(projectFile("examples/scenes/hat-on-coatrack.json"));
  OdeContacts contacts(document.scene);
  const Motion motion = simulate(document.scene, contacts, document.duration);
  const int hat = bodyIndex(document.scene, "hat");

  const DisplayMesh mesh = displayMesh(document.scene, hat, 5);
  std::printf("%zu vertices, %zu triangles\n", mesh.positions.size() / 3,
              (mesh.triangles.size() + mesh.accent.size()) / 3);

  const DisplayTrack track = displayTrack(motion, hat);
  std::printf("%zu arcs and %zu orientations for %.1f s\n", track.arcs.size(), track.turns.size(), motion.end);

  const double t = 0.5;
  const auto after = [t](const auto& key) { return key.time > t; };
  const auto& arc = *(std::find_if(track.arcs.begin(), track.arcs.end(), after) - 1);

  const auto next = std::find_if(track.turns.begin(), track.turns.end(), after), last = next - 1;
  const Quat from(last->w, last->x, last->y, last->z), to(next->w, next->x, next->y, next->z);
  const Quat turn = from.slerp((t - last->time) / (next->time - last->time), to);
  const Vec3 origin = arc.positionAt(t) - turn * track.center, is = motion.stateAt(hat, t).position;
  std::printf("at %.1f s the hat is drawn at %.3f %.3f %.3f, less than 0.1 mm from where it is: %s\n", t, origin.x(),
              origin.y(), origin.z(), (origin - is).norm() < 1e-4 ? "yes" : "no");
}
