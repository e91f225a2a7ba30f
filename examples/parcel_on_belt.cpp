// SPDX-License-Identifier: MIT
// A parcel is set down on a belt, rides to its end and slides on over the table behind it. The edit finds the speed of the belt
// that brings it to rest on a mark: it rides at that speed before the table slows it down.
#include <cstdio>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Scene beltAndTable() {
  Scene scene;
  scene.gravity = {0, 0, -9.81};
  scene.materials.push_back({.name = "rubber", .elasticity = 0, .friction = 0.5});
  scene.materials.push_back({.name = "steel", .elasticity = 0, .friction = 0.2});
  Body belt, table, parcel;
  belt.name = "belt", belt.fixed = true, belt.material = "rubber", belt.shape = Box{{1.6, 0.5, 0.1}};
  belt.position = {0, 0, 0.45}, belt.surface_velocity = {1.2, 0, 0};
  table.name = "table", table.fixed = true, table.material = "steel", table.shape = Box{{1.2, 0.8, 0.1}};
  table.position = {1.4, 0, 0.45};
  parcel.name = "parcel", parcel.material = "steel", parcel.mass = 1.5, parcel.shape = Box{{0.24, 0.18, 0.12}};
  parcel.position = {-0.5, 0, 0.56};
  scene.bodies = {belt, table, parcel};
  return scene;
}

}  // namespace

int main() {
  const Scene scene = beltAndTable();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2.4);
  edit.vary(surfaceVelocity("belt").only({"x"}));
  edit.nail("parcel", atRest()).position(1.5, any, any);
  const EditResult result = edit.solve();
  std::printf("%s, belt at %.4f m/s\n", nameOf(result.status), result.scene.bodies[0].surface_velocity.x());
  for (const Arc& arc : result.motion.world_lines[2].arcs) std::printf("  %.4f s: %s\n", arc.start(), nameOf(arc.kind()));
  std::printf("largest error below 1e-9: %s\n", result.residual < 1e-9 ? "yes" : "no");
  return result.solved() ? 0 : 1;
}
