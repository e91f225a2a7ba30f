// SPDX-License-Identifier: MIT
#include "tests/random/one_body_worlds.h"

#include <array>
#include <numbers>

#include "ode_bridge/convex_hull.h"
#include "tests/support/scenes.h"

namespace carom::one_body_worlds {
namespace {

using namespace test;

constexpr double kFar = 30;  // m, to where stairs and cut grounds reach
constexpr double kDegree = std::numbers::pi / 180;

std::shared_ptr<const Surface> prismOf(Random& r) {
  const int corners = 3 + r.below(22);
  const double radius = r.in(0.05, 0.25), half = r.in(0.01, 0.2);
  std::vector<Vec3> points;
  for (const double z : {-half, half})
    for (int i = 0; i < corners; ++i) {
      const double a = 2 * std::numbers::pi * i / corners;
      points.push_back({radius * std::cos(a), radius * std::sin(a), z});
    }
  return convexHull(points);
}

std::shared_ptr<const Surface> triangulated(const Surface& hull) {
  std::vector<std::array<int, 3>> triangles;
  for (const Surface::Face& face : hull.faces)
    for (int i = face.first + 1; i + 1 < face.first + face.count; ++i)
      triangles.push_back({hull.corners[static_cast<std::size_t>(face.first)], hull.corners[static_cast<std::size_t>(i)],
                           hull.corners[static_cast<std::size_t>(i) + 1]});
  return meshSurface(hull.vertices, triangles);
}

struct KindOfBody {
  const char* name;
  Shape (*make)(Random&);
};

double length(Random& r) { return r.in(0.04, 0.5); }

const std::array<KindOfBody, 9> kKindsOfBodies = {{
    {"ball", [](Random& r) -> Shape { return Sphere{r.in(0.02, 0.2)}; }},
    {"box", [](Random& r) -> Shape { return Box{{length(r), length(r), length(r)}}; }},
    {"cube", [](Random& r) -> Shape { return Box{Vec3::Constant(length(r))}; }},
    {"capsule", [](Random& r) -> Shape { return Capsule{r.in(0.02, 0.15), r.in(0.05, 0.4)}; }},
    {"cylinder", [](Random& r) -> Shape { return Cylinder{r.in(0.03, 0.2), r.in(0.02, 0.4)}; }},
    {"cone", [](Random& r) -> Shape { return Cone{r.in(0.03, 0.2), r.in(0.05, 0.4)}; }},
    {"prism", [](Random& r) -> Shape { return Hull{prismOf(r), 1, ""}; }},
    {"mesh", [](Random& r) -> Shape { return Mesh{triangulated(*prismOf(r)), 1, ""}; }},
    {"hull",
     [](Random& r) -> Shape {
       std::vector<Vec3> points;
       for (int i = 0; i < 10; ++i) points.push_back(r.in(0.06, 0.25) * r.unit());
       return Hull{convexHull(points), 1, ""};
     }},
}};

constexpr std::array kKindsOfGrounds = {"floor", "incline", "stairs", "groove", "pen", "cut"};

// Down along x, edges along y; a tread may be lower by a thousandth of a millimetre alone.
void addStairs(World& world, Random& r, const Quat& heading) {
  const Vec3 x = heading * Vec3::UnitX(), z = Vec3::UnitZ();
  double top = 0, edge = 0;
  for (int i = 0; i < 2; ++i) {
    const double rise = r.below(4) == 0 ? 1e-6 : r.in(0.02, 0.3), deep = rise + (r.below(2) ? 0 : r.in(0.1, 0.5));
    Body step = fixedBody(makeBox("step" + std::to_string(i), {kFar, kFar, deep}, heading * Vec3(edge - kFar / 2, 0, top - deep / 2)));
    step.orientation = heading;
    world.scene.bodies.push_back(step);
    world.grounds.push_back({z, top, Ground::Wall{x, edge}});
    top -= rise;
    edge += r.in(0.1, 0.8);
  }
  addPlane(world, z, top);
}

// A ground of flush boxes, cut along x and y.
void addPieces(World& world, Random& r, const Quat& heading) {
  const int columns = 2 + r.below(4), rows = 1 + r.below(3);
  std::vector<double> xs{-kFar}, ys{-kFar};
  for (int i = 1; i < columns; ++i) xs.push_back(xs.back() < -1 ? r.in(-0.6, 0) : xs.back() + r.in(0.05, 0.5));
  for (int i = 1; i < rows; ++i) ys.push_back(ys.back() < -1 ? r.in(-0.6, 0) : ys.back() + r.in(0.05, 0.5));
  xs.push_back(kFar), ys.push_back(kFar);
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double deep = r.in(0.1, 1);
      Body piece = fixedBody(makeBox("g" + std::to_string(i) + "_" + std::to_string(j), {xs[a + 1] - xs[a], ys[b + 1] - ys[b], deep},
                                     heading * Vec3((xs[a] + xs[a + 1]) / 2, (ys[b] + ys[b + 1]) / 2, -deep / 2)));
      piece.orientation = heading;
      world.scene.bodies.push_back(piece);
    }
  world.grounds.push_back({Vec3::UnitZ(), 0, std::nullopt});
}

void addGrounds(World& world, Random& r, int ground) {
  const double heading = r.below(2) ? 0 : r.in(0, 6.28);
  const Quat turn(Eigen::AngleAxisd(heading, Vec3::UnitZ()));
  switch (ground) {
    case 0: return addPlane(world, Vec3::UnitZ(), 0);
    case 1: {
      const double slope = r.in(5, 50) * kDegree;
      return addPlane(world, turn * Vec3(std::sin(slope), 0, std::cos(slope)), 0);
    }
    case 2: return addStairs(world, r, turn);
    case 3: {
      const double half = r.in(15, 75) * kDegree, lean = r.below(2) ? 0 : r.in(-0.3, 0.3) * half;
      const double fall = r.below(2) ? 0 : r.in(-0.3, 0.3);
      for (const double s : {1.0, -1.0}) {
        const double a = s * (std::numbers::pi / 2 - half) + lean;
        addPlane(world, turn * (Eigen::AngleAxisd(fall, Vec3::UnitX()) * Vec3(std::sin(a), 0, std::cos(a))), 0);
      }
      return;
    }
    case 4:
      addPlane(world, Vec3::UnitZ(), 0);
      for (int i = 0; i < 4; ++i)
        addPlane(world, turn * -Vec3(std::cos(i * std::numbers::pi / 2), std::sin(i * std::numbers::pi / 2), 0), -r.in(0.6, 1));
      return;
    default: return addPieces(world, r, turn);
  }
}

}  // namespace

void addPlane(World& world, const Vec3& n, double offset) {
  world.scene.bodies.push_back(makePlane("p" + std::to_string(world.grounds.size()), n, offset));
  world.grounds.push_back({n, offset, std::nullopt});
}

World worldOf(std::uint64_t seed) {
  Random r(seed);
  World world;
  const int kind = r.below(static_cast<int>(kKindsOfBodies.size())), ground = r.below(static_cast<int>(kKindsOfGrounds.size()));
  world.what = std::string(kKindsOfBodies[static_cast<std::size_t>(kind)].name) + " on " + kKindsOfGrounds[static_cast<std::size_t>(ground)];
  Body body = makeBall("body", 1, Vec3::Zero());
  body.shape = kKindsOfBodies[static_cast<std::size_t>(kind)].make(r);
  const int pose = r.below(5);  // upright, along and across, or any
  if (pose > 2) body.orientation = r.rotation();
  if (pose == 1) body.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX());
  if (pose == 2) body.orientation = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY());
  if (pose <= 2 && r.below(2)) body.orientation = Eigen::AngleAxisd(r.in(-3, 3), Vec3::UnitZ()) * body.orientation;
  body.velocity = {r.in(-2, 2), r.in(-2, 2), r.below(2) ? 0 : r.in(-1, 1)};
  if (r.below(4) == 0) body.velocity = {r.in(-2, 2), 0, 0};
  if (r.below(2)) body.angular_velocity = pose <= 2 && r.below(2) ? Vec3(0, 0, r.in(-8, 8)) : r.vec(6);
  constexpr std::array<double, 5> kBounces = {0, 1e-9, 0.3, 0.9, 1}, kRubs = {0, 1e-9, 0.2, 1, 10};
  const double e = kBounces[static_cast<std::size_t>(r.below(5))], mu = kRubs[static_cast<std::size_t>(r.below(5))];
  world.scene = makeScene({0, 0, -9.81}, e, mu, {body});
  addGrounds(world, r, ground);
  Body& placed = world.scene.bodies[0];
  placed.position = {r.in(-0.3, 0.3), r.in(-0.3, 0.3), 0};
  const double reach = kindOf(placed.shape).boundingRadius(placed.shape);
  // Above all of the ground, and down until it touches or nearly so.
  double height = 0;
  for (const Ground& g : world.grounds) height = std::max(height, (g.c + 2 * reach - g.n.dot(placed.position)) / std::max(g.n.z(), 0.1));
  placed.position.z() = height;
  for (int i = 0; i < 60; ++i) {
    double deepest = -1e300;
    for (const Ground& g : world.grounds)
      deepest = std::max(deepest, depthIn(g, {placed.shape, placed.orientation.toRotationMatrix(), placed.position}));
    if (deepest > -1e-13) break;
    placed.position.z() += deepest;
  }
  placed.position.z() += r.below(2) ? 2e-13 : r.in(0, 0.3);
  return world;
}

}  // namespace carom::one_body_worlds
