// SPDX-License-Identifier: MIT
#include "tests/random/lasting_worlds.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "ode_bridge/convex_hull.h"
#include "tests/support/scenes.h"
#include "tests/support/solids.h"

namespace carom::metamorphic {
namespace {

using namespace test;

constexpr std::array kKindNames = {"box", "cube", "ball", "cylinder", "capsule", "hull", "mesh"};
constexpr std::array kGroundNames = {"floor", "slope", "steps", "table", "groove", "walls", "mesh"};

double roundedOrNot(Random& r, double low, double high) {
  const double x = r.in(low, high);
  return r.below(2) ? std::max(0.05, std::round(20 * x) / 20) : x;
}

// A shape and how far its origin is above what it lies flat on, as it is listed; balls roll as they come.
struct Lying {
  Shape shape;
  double height;
  Quat pose = Quat::Identity();
};

Lying lyingShape(Random& r, int kind) {
  const double a = roundedOrNot(r, 0.05, 0.4), b = roundedOrNot(r, 0.05, 0.4), c = roundedOrNot(r, 0.05, 0.4);
  switch (kind) {
    case 0: return {Box{{a, b, c}}, c / 2};
    case 1: return {Box{{a, a, a}}, a / 2};
    case 2: return {Sphere{a / 2}, a / 2};
    case 3:
      if (r.below(2)) return {Cylinder{a / 2, b}, b / 2};
      return {Cylinder{a / 2, b}, a / 2, Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()))};
    case 4: return {Capsule{a / 4, b}, a / 4, Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()))};
    case 5: {
      std::vector<Vec3> points;
      const int corners = 3 + r.below(6);
      for (int i = 0; i < corners; ++i)
        for (const double z : {-c / 2, c / 2}) {
          const double turn = 2 * std::numbers::pi * i / corners;
          points.push_back({a / 2 * std::cos(turn), a / 2 * std::sin(turn), z});
        }
      return {Hull{convexHull(points), 1, ""}, c / 2};
    }
    default: return {Mesh{boxTriangles({a, b, c}).surface(), 1, ""}, c / 2};
  }
}

Body blockOf(const std::string& name, const Vec3& size, const Vec3& top) {
  return fixedBody(makeBox(name, size, top - Vec3(0, 0, size.z() / 2)));
}

Vec3 tilted(double about_y, double about_x) {
  return Eigen::AngleAxisd(about_y, Vec3::UnitY()) * (Eigen::AngleAxisd(about_x, Vec3::UnitX()) * Vec3::UnitZ());
}

std::vector<Body> groundOf(Random& r, int ground) {
  switch (ground) {
    case 0:
    case 1:  // where gravity leans
      if (r.below(2)) return {makePlane("floor", Vec3::UnitZ(), 0)};
      return {blockOf("floor", {6, 6, 1}, Vec3::Zero())};
    case 2: {
      const double run = roundedOrNot(r, 0.3, 0.7), rise = roundedOrNot(r, 0.05, 0.3);
      std::vector<Body> steps;
      for (int i = 0; i < 4; ++i)
        steps.push_back(blockOf("step" + std::to_string(i), {run, 4, 4}, {run * (i - 0.2), 0, -rise * i}));
      steps.push_back(makePlane("floor", Vec3::UnitZ(), -rise * 4));
      return steps;
    }
    case 3: return {blockOf("table", {1.2, 1.2, 0.1}, Vec3::Zero()), makePlane("floor", Vec3::UnitZ(), -0.7)};
    case 4: {
      const double lean = r.in(0.3, 0.9), fall = r.below(2) ? 0 : r.in(-0.2, 0.2);
      return {makePlane("left", tilted(lean, fall), 0), makePlane("right", tilted(-lean, fall), 0)};
    }
    case 5: {
      const double away = roundedOrNot(r, 0.5, 1);
      return {makePlane("floor", Vec3::UnitZ(), 0), makePlane("wall", -Vec3::UnitX(), -away),
              fixedBody(makeBox("box", {3, 0.2, 0.5}, {0, 1, 0.25}))};
    }
    default: {
      Body mesh = fixedBody(makeBox("mesh", {1, 1, 1}, {0, 0, -0.5}));
      mesh.shape = Mesh{boxTriangles({5, 5, 1}).surface(), 1, ""};
      return {mesh};
    }
  }
}

}  // namespace

LastingWorld lastingWorld(std::uint64_t seed) {
  Random r(977 * seed);
  const int ground = r.below(static_cast<int>(kGroundNames.size())), count = r.below(3) ? 1 : 2 + r.below(2);
  std::vector<Body> bodies = groundOf(r, ground);
  std::string name;
  double top = 0;
  for (int i = 0; i < count; ++i) {
    const int kind = r.below(static_cast<int>(kKindNames.size()));
    const Lying lying = lyingShape(r, kind);
    Body body = makeBall("body" + std::to_string(i), 1, Vec3::Zero());
    body.shape = lying.shape;
    body.mass = r.in(0.2, 3);
    const bool flat = ground != 4 && r.below(2);
    const Quat heading(Eigen::AngleAxisd(r.below(2) ? 0 : r.in(-3, 3), Vec3::UnitZ()));
    body.orientation = (heading * lying.pose).normalized();
    body.velocity = r.below(3) ? Vec3(r.in(-2, 2), r.in(-1, 1), 0) : Vec3(r.below(2), 0, 0);
    if (r.below(2)) body.angular_velocity = Vec3(0, 0, r.in(-5, 5));
    body.position = Vec3(roundedOrNot(r, 0, 0.1), roundedOrNot(r, 0, 0.1), lying.height);
    if (i > 0 && r.below(2)) body.position.head<2>() += Vec2(0.6 * i, 0.5);
    else body.position.z() += top;
    if (!flat) {
      const double reach = kindOf(body.shape).boundingRadius(body.shape);
      body.position.z() += ground == 4 ? 2 * reach + 0.3 : reach;
      if (r.below(2)) body.orientation = r.rotation();
      body.angular_velocity = r.vec(4);
    }
    top = body.position.z() + lying.height + (r.below(2) ? 0 : r.in(0, 0.2));
    bodies.insert(r.below(2) ? bodies.begin() : bodies.end(), body);
    name += (i ? ", " : "") + std::string(kKindNames[static_cast<std::size_t>(kind)]);
  }
  const double slope = ground == 1 ? r.in(-0.6, 0.6) : 0;
  const double e = std::array{0.0, 0.3, 0.7}[static_cast<std::size_t>(r.below(3))];
  const double mu = std::array{0.0, 0.1, 0.3, 0.8}[static_cast<std::size_t>(r.below(4))];
  const Vec3 gravity{9.81 * std::sin(slope), 0, -9.81 * std::cos(slope)};
  return {name + " on " + kGroundNames[static_cast<std::size_t>(ground)], makeScene(gravity, e, mu, bodies), r.in(0.8, 2.5)};
}

}  // namespace carom::metamorphic
