// SPDX-License-Identifier: MIT
// Three-cushion billiards, from a shot that meets nothing but a rail: "hit the yellow ball between 0.6 and 0.7 s, after the
// east rail", and then "red, three rails, yellow".
#include <cstdio>
#include <string>
#include <vector>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

Body ball(const char* name, const Vec3& place, const Vec3& velocity = Vec3::Zero()) {
  Body body;
  body.name = name, body.material = "ivory", body.mass = 0.21, body.shape = Sphere{0.03075};
  body.position = place, body.velocity = velocity;
  return body;
}

Scene table() {
  Scene scene;
  scene.gravity = Vec3::Zero();  // seen from above, on a cloth that does not slow anything
  scene.materials.push_back({.name = "ivory", .elasticity = 0.93, .friction = 0});
  const struct {
    const char* name;
    Vec3 inwards;
    double from_middle;
  } rails[] = {{"rail east", -Vec3::UnitX(), 1.42}, {"rail west", Vec3::UnitX(), 1.42},
               {"rail north", -Vec3::UnitY(), 0.71}, {"rail south", Vec3::UnitY(), 0.71}};
  for (const auto& rail : rails) {
    Body body;
    body.name = rail.name, body.fixed = true, body.material = "ivory";
    body.shape = Plane{rail.inwards, -rail.from_middle};
    scene.bodies.push_back(body);
  }
  scene.bodies.push_back(ball("cue", {-0.7, -0.2, 0}, {4, 0, 0}));
  scene.bodies.push_back(ball("red", {0.4, 0.3, 0}));
  scene.bodies.push_back(ball("yellow", {0.9, -0.45, 0}));
  return scene;
}

void print(const char* wish, const EditResult& result) {
  const Motion& motion = result.motion;
  const int cue = bodyIndex(*motion.scene, "cue");
  std::printf("%s: %s\n  the cue ball meets", wish, result.solved() ? "solved" : "not solved");
  int count = 0;
  for (const Event& event : motion.events)
    for (const Contact& c : event.contacts)
      if ((c.a == cue || c.b == cue) && ++count <= 5)
        std::printf(" %s", motion.scene->bodies[static_cast<std::size_t>(c.a == cue ? c.b : c.a)].name.c_str());
  std::printf("\n");
}

}  // namespace

int main() {
  const Scene scene = table();
  OdeContacts contacts(scene);
  Edit hit(scene, contacts, 4);
  hit.vary(velocity("cue").only({"x", "y"}));
  hit.hit("cue", Hit{.with = "yellow", .during = {{0.6, 0.7}}, .after = ImpactOf{"cue", 1, "rail east"}});
  EditOptions options;
  options.effort = Effort::fast;  // the first way will do
  print("yellow after a rail", hit.solve(options));

  Edit cushions(scene, contacts, 6);
  cushions.vary(velocity("cue").only({"x", "y"}));
  cushions.sequence({"cue red", "cue rail*", "cue rail*", "cue rail*", "cue yellow"});
  print("three cushions", cushions.solve());
}
