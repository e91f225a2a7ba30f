// SPDX-License-Identifier: MIT
#include "tests/threads/scenes.h"

#include "tests/support/scenes.h"

namespace carom::threads {
namespace {

using namespace test;

const Vec3 kDown(0, 0, -9.81);

// Walls about [0, size]^3.
void addWalls(std::vector<Body>& bodies, double size) {
  for (int k = 0; k < 3; ++k) {
    bodies.push_back(makePlane("low " + std::to_string(k), Vec3::Unit(k), 0));
    bodies.push_back(makePlane("high " + std::to_string(k), -Vec3::Unit(k), -size));
  }
}

// side^3 balls and boxes in a lattice.
Case pen(int side, bool boxes, double elasticity, double friction, std::size_t impacts) {
  Random random(static_cast<std::uint64_t>(side));
  std::vector<Body> bodies;
  addWalls(bodies, 0.3 * side);
  for (int i = 0; i < side * side * side; ++i) {
    const Vec3 at = 0.3 * Vec3(i % side + 0.5, i / side % side + 0.5, i / (side * side) + 0.5) + random.vec(0.02);
    const std::string name = std::to_string(i);
    Body body = boxes && i % 4 == 0 ? makeBox(name, {0.1, 0.14, 0.08}, at) : makeBall(name, 0.1, at);
    body.velocity = random.vec(3);
    body.angular_velocity = random.vec(5);
    body.orientation = random.rotation();
    bodies.push_back(body);
  }
  return {(boxes ? "boxes and balls " : "balls ") + std::to_string(side),
          makeScene(kDown, elasticity, friction, bodies), 100, impacts};
}

Case thrown(std::uint64_t seed) { return {"thrown " + std::to_string(seed), randomScene(seed), 1.5, 200}; }

// Lands on corners, edges and a face, and comes to rest.
Case die(std::uint64_t seed, double elasticity, double friction) {
  Random random(seed);
  Body body = makeBox("die", Vec3::Constant(0.016), {0, 0, 0.08});
  body.orientation = random.rotation();
  body.velocity = random.vec(1);
  body.angular_velocity = random.vec(30);
  return {"die " + std::to_string(seed),
          makeScene(kDown, elasticity, friction, {body, makePlane("floor", Vec3::UnitZ(), 0)}), 10, 20000};
}

std::vector<Case> makeCases() {
  return {thrown(11),
          thrown(12),
          thrown(13),
          pen(2, true, 0.9, 0.2, 100),
          pen(4, true, 0.95, 0.3, 150),
          pen(5, false, 1, 0, 1500),
          die(1, 0.5, 0.4),
          die(2, 0.2, 0.1)};
}

}  // namespace

const std::vector<Case>& allCases() {
  static const std::vector<Case> cases = makeCases();
  return cases;
}

}  // namespace carom::threads
