// SPDX-License-Identifier: MIT
#include "bench/edits/throws.h"

#include "ode_bridge/convex_hull.h"

namespace carom::bench {
namespace {

const Vec3 kGravity(0, 0, -9.81);

Material drawMaterial(const std::string& name, Dice& dice) {
  Material m;
  m.name = name;
  m.elasticity = dice.in(0.5, 0.95);
  m.friction = dice.chance(0.1) ? 0 : dice.in(0.05, 0.6);
  m.tangential_elasticity = dice.chance(0.3) ? dice.in(-0.5, 0.5) : 0;
  return m;
}

Body fixedBody(const std::string& name, Shape shape) {
  Body body;
  body.name = name;
  body.fixed = true;
  body.material = "ground";
  body.shape = std::move(shape);
  return body;
}

void addSurroundings(Scene& scene, Dice& dice) {
  Vec3 up = Vec3::UnitZ();
  if (dice.chance(0.25)) up = (up + 0.15 * dice.inCube(1)).normalized();
  scene.bodies.push_back(fixedBody("floor", Plane{up, 0}));
  if (dice.chance(0.5)) {
    scene.bodies.push_back(fixedBody("wall", Plane{-Vec3::UnitX(), -dice.in(0.5, 1.2)}));
    if (dice.chance(0.5)) scene.bodies.push_back(fixedBody("side", Plane{-Vec3::UnitY(), -dice.in(0.4, 0.8)}));
  }
  if (dice.chance(0.3)) {
    Body block = fixedBody("block", Box{dice.inBox({0.1, 0.2, 0.1}, {0.4, 0.5, 0.3})});
    const double across = dice.in(-0.1, 0.1), along = dice.in(0.25, 0.45);
    block.position = Vec3(along, across, 0.1);
    block.orientation = Quat(Eigen::AngleAxisd(dice.in(-0.5, 0.5), Vec3::UnitZ()));
    scene.bodies.push_back(block);
  }
}

Shape drawBall(Dice& dice) { return Sphere{dice.logIn(0.05, 0.3) / 2}; }

Shape drawBox(Dice& dice) {
  if (dice.chance(0.2)) return Box{Vec3::Constant(dice.logIn(0.06, 0.2))};
  const double x = dice.logIn(0.06, 0.3), y = dice.logIn(0.06, 0.3), z = dice.logIn(0.06, 0.3);
  return Box{{x, y, z}};
}

std::vector<Vec3> dieOfEight(double radius) {
  std::vector<Vec3> corners;
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0}) corners.push_back(sign * radius * Vec3::Unit(axis));
  return corners;
}

std::vector<Vec3> pebble(Dice& dice) {
  const double x = dice.in(0.04, 0.14), y = dice.in(0.04, 0.14), z = dice.in(0.04, 0.14);
  std::vector<Vec3> cloud;
  for (int count = dice.integer(6, 14), i = 0; i < count; ++i)
    cloud.push_back(Vec3(x, y, z).cwiseProduct(dice.direction()));
  return cloud;
}

Shape drawHull(Dice& dice) {
  Hull hull;
  hull.surface = convexHull(dice.chance(0.25) ? dieOfEight(dice.in(0.05, 0.12)) : pebble(dice));
  return hull;
}

Shape drawShape(Family family, Dice& dice) {
  switch (family) {
    case Family::ball:
      return drawBall(dice);
    case Family::box:
      return drawBox(dice);
    default:
      return drawHull(dice);
  }
}

Body drawBody(const std::string& name, const std::string& material, Family family, Dice& dice) {
  Body body;
  body.name = name;
  body.material = material;
  body.shape = drawShape(family, dice);
  if (dice.chance(0.5)) {
    body.mass = dice.logIn(0.1, 3);
  } else {
    body.density = dice.logIn(200, 3000);
  }
  body.orientation = dice.rotation();
  const Vec3 axis = dice.direction();
  body.angular_velocity = dice.in(0, 8) * axis;
  return body;
}

Scene oneThrow(Family family, Dice& dice) {
  Scene scene;
  scene.materials = {drawMaterial("ground", dice), drawMaterial("stuff", dice)};
  addSurroundings(scene, dice);
  Body body = drawBody("thrown", "stuff", family, dice);
  body.position = dice.inBox({-0.6, -0.3, 0.35}, {-0.1, 0.3, 1.1});
  body.velocity = dice.inBox({0.5, -0.8, -2}, {3, 0.8, 2});
  scene.bodies.push_back(body);
  return scene;
}

// Two bodies, each thrown so that it would be near `place` at time `t`.
Scene meeting(Dice& dice) {
  Scene scene;
  scene.materials = {drawMaterial("ground", dice), drawMaterial("stuff", dice), drawMaterial("other stuff", dice)};
  const bool floating = dice.chance(0.15);
  if (floating) {
    scene.gravity = Vec3::Zero();
  } else {
    scene.gravity = kGravity;
    addSurroundings(scene, dice);
  }
  const Vec3 place = dice.inBox({-0.2, -0.1, 0.3}, {0.1, 0.1, 0.9});
  const double t = dice.in(0.12, 0.35);
  for (const char* name : {"thrown", "other"}) {
    const bool first = scene.bodies.empty() || scene.bodies.back().fixed;
    const Family shape = static_cast<Family>(dice.integer(0, 2));
    Body body = drawBody(name, first ? "stuff" : "other stuff", shape, dice);
    const double side = first ? 1 : -1;
    body.velocity = dice.inBox({0.8, -0.8, -1}, {3, 0.8, 2});
    body.velocity.x() *= side;
    const double reach = kindOf(body.shape).boundingRadius(body.shape);
    const Vec3 near = place + 0.4 * reach * dice.inCube(1);
    body.position = near - t * body.velocity - 0.5 * t * t * scene.gravity;
    scene.bodies.push_back(body);
  }
  return scene;
}

}  // namespace

Scene drawThrow(Family family, Dice& dice) {
  return family == Family::meeting ? meeting(dice) : oneThrow(family, dice);
}

}  // namespace carom::bench
