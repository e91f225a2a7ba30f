// SPDX-License-Identifier: MIT
#include "tests/reference/cases.h"

#include <algorithm>

namespace carom::reference {
namespace {

Quat turned(const Vec3& rotation) { return Quat(Eigen::AngleAxisd(rotation.norm(), rotation.normalized())); }

Body moving(const char* name, const Shape& shape, const char* material, const Vec3& position, const Vec3& rotation,
            const Vec3& velocity, const Vec3& spin) {
  Body body = makeBody(name, shape, material);
  body.position = position;
  body.orientation = turned(rotation);
  body.velocity = velocity;
  body.angular_velocity = spin;
  return body;
}

Material rough(const char* name, double elasticity, double friction, double tangential) {
  Material m;
  m.name = name, m.elasticity = elasticity, m.friction = friction, m.tangential_elasticity = tangential;
  return m;
}

/// A box with three different written moments, a tilted first impact, an (untilted) tilt at the second.
Scene boxOnPlane() {
  Scene s;
  s.materials = {rough("cardboard", 0.55, 0.3, 0.2), rough("wood", 0.7, 0.24, -0.1)};
  Body box = moving("box", Box{{0.3, 0.22, 0.12}}, "cardboard", {0.1, -0.2, 0.9}, {-0.7, 1.24, -1.0}, {1.4, 0.5, -0.3},
                    {-1.86, -3.64, 3.55});
  box.mass = 0.8;
  box.inertia = Inertia::fromMoments({0.0044, 0.0071, 0.0092});
  s.bodies = {box, makeFloor("wood")};
  s.tilts = {{"box", 1, {0.03, -0.02}}, {"box", 2, {0, 0}}};
  return s;
}

Scene boxOnPlaneFrictionless() {
  Scene s = boxOnPlane();
  for (Material& m : s.materials) m.friction = 0, m.combine_elasticity = Combine::multiply;
  s.bodies[1].orientation = turned({0.12, -0.07, 0.3});
  s.bodies[1].position = {0.02, 0.03, -0.04};
  return s;
}

/// Two boxes in free space, the corner of one against a face of the other.
Scene boxCornerOnFace() {
  Scene s;
  s.gravity = {0.3, -0.2, -1.1};
  s.materials = {rough("cork", 0.6, 0.35, 0.1), rough("slate", 0.8, 0.5, 0)};
  s.materials[0].combine_friction = Combine::minimum, s.materials[1].combine_friction = Combine::maximum;
  Body a = moving("pointed", Box{{0.5, 0.4, 0.3}}, "cork", {-0.89, -0.07, -0.22}, {0.09, 0.97, 0.42},
                  {1.64, -0.07, -0.24}, {3.63, 1.37, 4.99});
  a.mass = 1.3;
  a.inertia = Inertia::fromMoments({0.03, 0.041, 0.052});
  Body b = moving("flat", Box{{0.3, 0.9, 0.8}}, "slate", {0.4, -0.05, 0.03}, {0.05, -0.04, 0.08}, {-0.7, 0.05, -0.1},
                  {0.3, 0.2, -0.1});
  b.density = 11;
  s.bodies = {a, b};
  s.tilts = {{"flat", 1, {-0.04, 0.05}}};
  return s;
}

/// Two boxes in free space that cross like swords; one inertia is written as a full matrix.
Scene boxEdgeOnEdge() {
  Scene s = boxCornerOnFace();
  s.materials[0].combine_friction = s.materials[1].combine_friction = Combine::multiply;
  s.materials[0].friction = 0.9, s.materials[1].friction = 1.2;
  Body a = moving("sword", Box{{0.12, 0.14, 1.2}}, "cork", {-0.6, 0.04, 0.05}, {0.05, 0.1, 0.7}, {1.3, 0.1, 0.1},
                  {0.3, -0.4, 0.2});
  a.density = 60;
  Body b = moving("shield", Box{{0.15, 1.1, 0.13}}, "slate", {0.4, -0.05, 0.08}, {0.1, 0.75, 0.06}, {-0.9, 0.05, -0.1},
                  {0.2, 0.3, -0.5});
  b.mass = 1.7;
  Mat3 inertia;
  inertia << 0.17, 0.006, -0.004, 0.006, 0.02, 0.003, -0.004, 0.003, 0.18;
  b.inertia = Inertia::fromMatrix(inertia);
  s.bodies = {a, b};
  s.tilts = {{"shield", 1, {0.02, 0.03}}};
  return s;
}

/// A ball that strikes a flying, spinning box from the given place.
Scene ballOnBox(const Vec3& from, const Vec3& velocity, const Vec3& spin) {
  Scene s;
  s.gravity = {0, 0, -9.81};
  s.materials = {rough("rubber", 0.85, 0.6, 0.4), rough("tin", 0.5, 0.2, 0)};
  s.materials[0].combine_elasticity = Combine::maximum, s.materials[1].combine_elasticity = Combine::minimum;
  Body ball = moving("ball", Sphere{0.11}, "rubber", from, {0.3, 0.2, 0.1}, velocity, spin);
  ball.density = 800;
  Body box =
      moving("tin", Box{{0.5, 0.36, 0.28}}, "tin", {0, 0, 2}, {0.4, -0.3, 0.6}, {-0.5, 0.2, 1.1}, {1.9, 2.3, -1.4});
  box.mass = 2.1;
  s.bodies = {ball, box};
  s.tilts = {{"ball", 1, {0.05, 0.01}}};
  return s;
}
Scene ballOnBoxFace() { return ballOnBox({-1.03, 0.19, 2.27}, {3.9, 0.12, 0.9}, {4.88, 4.88, -0.18}); }
Scene ballOnBoxEdge() { return ballOnBox({-1.39, -0.23, 2.15}, {4.08, 0.34, 1.06}, {1.24, 1.92, -0.68}); }
Scene ballOnBoxCorner() { return ballOnBox({-1.08, -0.03, 2.33}, {3.98, 0.07, 0.83}, {4.32, -2.75, -3.83}); }

/// Two balls of different size and inertia, then the floor.
Scene ballOnBall() {
  Scene s;
  s.materials = {rough("ivory", 0.92, 0.06, 0), rough("cloth", 0.45, 0.6, 0.3)};
  Body cue = moving("cue", Sphere{0.05}, "ivory", {-0.5, 0.02, 0.4}, {0.2, 0.1, 0.4}, {3, 0.1, 1.6}, {8, -12, 20});
  cue.mass = 0.21;
  Body object = moving("object", Sphere{0.06}, "ivory", {0, 0.06, 0.42}, {0.1, 0.5, 0}, {0.1, 0, 1.2}, {0, 3, -2});
  object.mass = 0.17;
  object.inertia = Inertia::fromMoments({0.0002, 0.00024, 0.00029});
  s.bodies = {cue, makeFloor("cloth"), object};
  s.tilts = {{"object", 1, {0.01, -0.02}}};
  return s;
}

/// A box thrown against a wall that is itself a box, turned a little out of the axes.
Scene boxOnWall() {
  Scene s;
  s.materials = {rough("book", 0.5, 0.45, 0.1), rough("brick", 0.6, 0.4, 0.2)};
  Body wall = makeFixed("wall", Box{{0.3, 2, 1.6}}, "brick");
  wall.position = {1.2, 0.1, 0.8};
  wall.orientation = turned({0.1, -0.15, 0.2});
  Body book = moving("book", Box{{0.24, 0.17, 0.05}}, "book", {-0.01, 0.22, 1.17}, {1.31, -0.15, -0.35},
                     {3.11, -0.43, 2.37}, {-1.43, -3.07, -4});
  book.density = 320;
  s.bodies = {wall, book};
  s.tilts = {{"book", 1, {0.02, 0.01}}, {"book", 2, {-0.03, 0.04}}};
  return s;
}

/// A body with two equal moments whose moments may vary one by one: its derivative is not a symmetric body's.
Scene symmetricBody() {
  Scene s = boxOnPlane();
  s.bodies[0].shape = Box{{0.2, 0.2, 0.09}};
  s.bodies[0].inertia = Inertia::fromMoments({0.0035, 0.0035, 0.0058});
  return s;
}

/// The same with all three moments equal: a cube.
Scene sphericalBody() {
  Scene s = boxOnPlane();
  s.bodies[0].shape = Box{{0.2, 0.2, 0.2}};
  s.bodies[0].inertia = Inertia::fromMoments({0.005, 0.005, 0.005});
  return s;
}

/// A box that gravity pulls less, thrown on a kinematic one that moves and turns.
Scene boxOnKinematic() {
  Scene s = boxOnPlane();
  s.bodies[0].gravity_factor = 0.6;
  Body lift = moving("lift", Box{{1.9, 2.1, 0.3}}, "wood", {0.1, -0.1, 0.05}, {0.05, -0.04, 0.3}, {0.2, -0.1, 0.45},
                     {0.1, -0.2, 0.3});
  lift.kinematic = true;
  lift.gravity_factor = 2;  // has no say
  s.bodies[1] = lift;
  s.tilts = {{"box", 1, {0.03, -0.02}}};
  return s;
}

/// The same where its surface moves besides.
Scene boxOnKinematicBelt() {
  Scene s = boxOnKinematic();
  s.bodies[1].surface_velocity = {0.4, -0.3, 0.2}, s.bodies[1].surface_angular_velocity = {0.5, -0.6, 1.2};
  return s;
}

/// A box on a floor that is a belt, and a ball on the edge of a box whose surface turns.
Scene boxOnBelt() {
  Scene s = boxOnPlane();
  s.bodies[1].surface_velocity = {0.9, 0.2, -0.1};
  return s;
}
Scene ballOnTurningEdge() {
  Scene s = ballOnBoxEdge();
  for (Body& b : s.bodies) {
    if (!std::holds_alternative<Box>(b.shape)) continue;
    b.fixed = true, b.velocity.setZero(), b.angular_velocity.setZero();
    b.surface_velocity = {0.3, -0.5, 0.2}, b.surface_angular_velocity = {0.7, 0.4, -1.3};
  }
  return s;
}

}  // namespace

Body makeBody(const std::string& name, const Shape& shape, const std::string& material) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.material = material;
  return body;
}

Body makeFixed(const std::string& name, const Shape& shape, const std::string& material) {
  Body body = makeBody(name, shape, material);
  body.fixed = true;
  return body;
}

Body makeFloor(const std::string& material) { return makeFixed("floor", Plane{}, material); }

Scene reversed(Scene scene) {
  std::reverse(scene.bodies.begin(), scene.bodies.end());
  return scene;
}

const std::vector<Case>& cases() {
  constexpr ImpactMode frictionless = ImpactMode::frictionless, stick = ImpactMode::stick, slide = ImpactMode::slide;
  static const std::vector<Case> table = {
      {"box_on_plane", boxOnPlane, 0.9, {stick, slide, slide}, {"vertex", "vertex", "vertex"}},
      {"box_on_plane_frictionless",
       boxOnPlaneFrictionless,
       0.68,
       {frictionless, frictionless, frictionless},
       {"vertex", "vertex", "vertex"}},
      {"box_corner_on_face", boxCornerOnFace, 0.62, {stick, slide}, {"face", "edge"}},
      {"box_edge_on_edge", boxEdgeOnEdge, 0.7, {stick}, {"edge"}},
      {"ball_on_box_face", ballOnBoxFace, 0.4, {slide}, {"face"}},
      {"ball_on_box_edge", ballOnBoxEdge, 0.5, {slide, slide}, {"edge", "face"}},
      {"ball_on_box_corner", ballOnBoxCorner, 0.4, {slide, slide}, {"vertex", "face"}},
      {"ball_on_ball", ballOnBall, 0.6, {slide, stick, stick}, {"sphere on sphere", "plane", "plane"}},
      {"box_on_wall", boxOnWall, 0.6, {slide, stick, slide}, {"vertex", "edge", "vertex"}},
      {"symmetric_body", symmetricBody, 0.9, {stick, slide}, {"vertex", "vertex"}},
      {"box_on_kinematic", boxOnKinematic, 0.7, {ImpactMode::stick, ImpactMode::stick}, {"face", "face"}},
      {"box_on_kinematic_belt", boxOnKinematicBelt, 0.7, {stick, stick}, {"face", "face"}},
      {"box_on_belt", boxOnBelt, 0.9, {stick, stick, slide}, {"vertex", "vertex", "vertex"}},
      {"ball_on_turning_edge", ballOnTurningEdge, 0.5, {stick}, {"edge"}},
      {"spherical_body", sphericalBody, 0.76, {stick, slide}, {"vertex", "vertex"}},
  };
  return table;
}

}  // namespace carom::reference
