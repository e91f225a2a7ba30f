// SPDX-License-Identifier: MIT
// The billiard that DiffTaichi optimises: the cue ball breaks a rack, and is placed and thrown otherwise until the last
// ball of the rack is at a target after three seconds. Ten balls are what was published, fifteen have one layer more.
#include <cstdio>
#include <string>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"

using namespace carom;

namespace {

constexpr double kRadius = 0.03, kDuration = 1023 * 0.003;

Body ball(const std::string& name, double x, double y) {
  Body body;
  body.name = name, body.material = "resin", body.mass = 1;
  body.shape = Sphere{kRadius}, body.position = {x, y, 0};
  return body;
}

// Each layer is a diameter behind the one before it, and its balls touch.
Scene rack(int layers) {
  Scene scene;
  scene.gravity = {0, 0, 0};
  scene.materials.push_back({.name = "resin", .elasticity = 0.8, .friction = 0});
  scene.bodies.push_back(ball("cue", 0.1, 0.5));
  scene.bodies[0].velocity = {0.3, 0, 0};
  for (int i = 0; i < layers; ++i)
    for (int j = 0; j <= i; ++j)
      scene.bodies.push_back(ball("ball " + std::to_string(scene.bodies.size()), 0.5 + 2 * kRadius * i,
                                  0.5 + 2 * kRadius * j - 0.7 * kRadius * i));
  return scene;
}

void sendLastBall(int layers) {
  const Scene scene = rack(layers);
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, kDuration);
  edit.vary(position("cue").only({"x", "y"}), velocity("cue").only({"x", "y"}));
  const std::string last = scene.bodies.back().name;
  edit.nail(last, kDuration).position(0.9, 0.75, any);
  const EditResult result = edit.solve();
  const Vec3 at = result.motion.stateAt(last, kDuration).position;
  std::printf("%zu balls: %s at (%.4f, %.4f), largest error below 1e-9: %s\n", scene.bodies.size() - 1, last.c_str(),
              at.x(), at.y(), result.solved() && result.residual < 1e-9 ? "yes" : "no");
}

}  // namespace

int main() {
  sendLastBall(4);
  sendLastBall(5);
}
