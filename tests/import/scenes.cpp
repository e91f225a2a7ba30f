// SPDX-License-Identifier: MIT
#include "tests/import/scenes.h"

#include <algorithm>
#include <array>
#include <random>

#include "ode_bridge/convex_hull.h"

namespace carom::import_tests {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

/// A tetrahedron with one face pushed in: closed and concave.
std::shared_ptr<const Surface> dentedTetrahedron(double size) {
  return meshSurface({{0, 0, 0}, {size, 0, 0}, {0, 1.1 * size, 0}, {0, 0, 0.9 * size}, {0.25 * size, 0.25 * size, 0.1}},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}});
}

std::shared_ptr<const Surface> openRoof() {
  return meshSurface({{-1, -1, 0}, {1, -1, 0}, {1, 1.0 / 3, 0.4}, {-1, 1.0 / 3, 0.4}, {1, 1, 0}, {-1, 1, 0}},
                     {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}});
}

std::shared_ptr<const Surface> randomHull(std::mt19937& random, int points) {
  std::uniform_real_distribution<double> side(-0.3, 0.3);
  std::vector<Vec3> cloud;
  for (int i = 0; i < points; ++i) cloud.emplace_back(side(random), side(random), side(random));
  return convexHull(cloud);
}

Body bodyOf(const std::string& name, Shape shape, const Vec3& position) {
  Body body;
  body.name = name, body.shape = std::move(shape), body.position = position;
  return body;
}

Body fixedBody(const std::string& name, Shape shape, const Vec3& position, const Quat& orientation) {
  Body body = bodyOf(name, std::move(shape), position);
  body.fixed = true, body.orientation = orientation.normalized();
  return body;
}

Compound hat(const std::shared_ptr<const Surface>& hull, const std::shared_ptr<const Surface>& mesh) {
  const Quat turn = Quat(0.3, -0.2, 0.9, 0.1).normalized();
  Compound inner;
  inner.parts = {{Capsule{0.02, 0.1}, {0, 0.01, 0}, turn}, {Hull{hull, 0.3, ""}, {0.1, 0, 0}, Quat::Identity()}};
  Compound whole;
  whole.parts = {{Cylinder{0.16, 0.01}, Vec3::Zero(), Quat::Identity()},
                 {Cylinder{0.09, 0.12}, {0, 0, 0.06}, Quat(0.9, 0.1, 0.2, 0.3).normalized()},
                 {inner, {1.0 / 3, 0, 0.2}, turn.conjugate()},
                 {Mesh{mesh, 1, ""}, {0, -0.2, 0}, turn},
                 {Box{{0.1, 0.2, 0.3}}, {0, 0.2, 0}, turn},
                 {Sphere{0.07}, {0.1, 0.1, 0.1}, Quat::Identity()}};
  return whole;
}

void addMaterialsAndEdit(Document& document) {
  Scene& scene = document.scene;
  scene.gravity = {0.1, -0.2, -9.81};
  scene.materials = {{"felt", 0.45, 0.6, 0.1, Combine::average, Combine::multiply},
                     {"Holz, \xC3\xB6lig", 1.0 / 3, 0.1 / 3, -0.25, Combine::maximum, Combine::minimum},
                     {"unused", 0, 0, 0, Combine::multiply, Combine::maximum}};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (i % 3 != 2) scene.bodies[i].material = scene.materials[i % 3].name;
  scene.tilts = {{"capsule", 2, {0.01, -1.0 / 7}}};
  document.duration = 0.7 + 1.0 / 3;
  document.controls = {velocity("sphere"), size("box").only({"x", "z"}), elasticity("felt").within(0.2, 0.9)};
  document.controls[1].weight = 0.3;
  document.constraints = {{"sphere",
                           0.9,
                           {{"velocity", {any, any, 0.25}, Vec3::Zero()},
                            {"position", {1.0 / 3, any, any}, Vec3::Zero()},
                            {"orientation", {1, 0, 0, 0}, Vec3::Zero()}}},
                          {"capsule", nthImpact(1, "floor"), {{"velocity", {any, 0.1, any}, Vec3::Zero()}}}};
  Constraint near{"box", between(1.0 / 7, 1.0 / 3), {{"position", {any, any, any}}}, "capsule"};
  near.targets[0].min = {-1.0 / 3, any, any}, near.targets[0].max = {0.1 + 0.2, 1.0 / 7, any};
  Constraint regions{"sphere", 0.0, {}};
  regions.regions = {{Region::Side::inside, Box{{9, 9, 9.0 / 7}}, {0, 0, 1.0 / 3}, Quat::Identity(), {}, 0.1 / 3},
                     {Region::Side::avoid, Sphere{0.1 / 7}, {3, 0, 0}, Quat(0, 0.6, 0, 0.8), {{0.1, 0.7}}, {}},
                     {Region::Side::avoid, Box{{0.1, 0.2, 0.3}}, {4, 0, 0}, Quat(0.28, 0.96, 0, 0), {}, {}}};
  document.constraints.insert(document.constraints.end(), {near, regions});
}

}  // namespace

Document documentOfEveryKind() {
  std::mt19937 random(7);
  const auto hull = randomHull(random, 300), mesh = dentedTetrahedron(0.7 / 3);
  Document document;
  std::vector<Body>& bodies = document.scene.bodies;
  const Quat odd(0.3, -0.5, 0.1, 0.7);
  bodies = {fixedBody("floor", Plane{}, Vec3::Zero(), Quat::Identity()),
            fixedBody("slope", Plane{Vec3(0.3, -0.2, 0.9).normalized(), -1.0 / 3}, {0.1, 0.2, -3}, odd),
            fixedBody("post", Capsule{0.1, 1}, {4, 0, 1}, odd),
            fixedBody("drum", Cylinder{0.3, 0.2}, {4, 2, 1}, odd),
            fixedBody("spire", Cone{0.3, 0.7}, {4, 3, 1}, odd),
            fixedBody("stone", Hull{hull, 1.7, ""}, {4, 4, 1}, odd),
            fixedBody("terrain", Mesh{openRoof(), 0.8, ""}, {4, 6, 1}, odd),
            fixedBody("shed", hat(hull, mesh), {4, 8, 1}, odd),
            fixedBody("wall", Box{{0.1, 1, 2}}, {-3, 0, 1}, odd),
            bodyOf("sphere", Sphere{0.1}, {0, 0, 1}),
            bodyOf("box", Box{{0.3, 0.2, 0.1}}, {0, 1, 1}),
            bodyOf("capsule", Capsule{0.06, 0.2}, {0, 2, 1}),
            bodyOf("cylinder", Cylinder{0.1, 0.15}, {0, 3, 1}),
            bodyOf("hull", Hull{hull, 1, ""}, {0, 4, 1}),
            bodyOf("scaled hull", Hull{hull, 0.8, ""}, {0, 5, 1}),
            bodyOf("mesh", Mesh{mesh, 1, ""}, {0, 6, 1}),
            bodyOf("scaled mesh", Mesh{mesh, 1.0 / 3, ""}, {0, 7, 1}),
            bodyOf("hat <1> \"x\"", hat(hull, mesh), {0, 8, 1}),
            bodyOf("cone", Cone{0.1, 0.15}, {0, 9, 1}),
            bodyOf("open mesh", Mesh{openRoof(), 0.5, ""}, {0, 10, 1})};
  int k = 0;
  for (Body& body : bodies) {
    if (body.fixed) continue;
    body.orientation = Quat(0.9, 0.3 - 0.1 * k, 0.05 * k - 0.2, 0.25).normalized();
    body.velocity = {0.2, -0.1 * k, 1.0 / 3};
    body.angular_velocity = {4, 7.0 - k, -1.0 / 7};
    if (k % 2 == 0) body.mass = 0.7 + 1.0 / (k + 3);
    if (k % 2 == 1) body.density = 700.0 / 3 + k;
    if (k % 3 == 1) body.inertia = Inertia::fromMoments({0.02, 0.03, 0.04 + 0.001 / 3});
    Mat3 matrix;
    matrix << 0.03, 0.001, -0.002, 0.001, 0.04, 0.0015, -0.002, 0.0015, 0.05;
    if (k % 3 == 2) body.inertia = Inertia::fromMatrix(matrix);
    if (k % 4 == 3) body.center_of_mass = Vec3(0.01, -0.02, 0.1 / 3);
    ++k;
  }
  const auto named = [&](const char* name) -> Body& {
    return *std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name == name; });
  };
  named("cylinder").kinematic = true;
  for (const char* belt : {"cylinder", "wall", "slope", "shed"}) {
    named(belt).surface_velocity = {1.0 / 3, -0.2, 0.1}, named(belt).surface_angular_velocity = {0.3, 2.0 / 7, -1};
  }
  named("capsule").gravity_factor = -1.0 / 3;
  named("sphere").collision_filter = {{"b\xC3\xA4lle", "small"}, {}, {"walls", "drums"}};
  named("hat <1> \"x\"").collision_filter = {{}, {"small"}, {}};
  named("drum").collision_filter = named("post").collision_filter = {{"drums"}, {}, {}};
  Body& open = bodies.back();
  open.mass = 1.5, open.density.reset();
  open.inertia = Inertia::fromMoments({0.2, 0.3, 0.4});
  addMaterialsAndEdit(document);
  return document;
}

namespace {

class RandomBodies {
 public:
  explicit RandomBodies(std::uint32_t seed) : random_(seed) {}

  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int whole(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }
  Vec3 vector(double size) { return {real(-size, size), real(-size, size), real(-size, size)}; }
  Quat turn() {
    if (whole(4) == 0) return Quat::Identity();
    return Quat(real(-1, 1), real(-1, 1), real(-1, 1), 1.1).normalized();
  }

  Shape shape(int depth) {
    switch (whole(depth < 2 ? 7 : 6)) {
      case 0:
        return Sphere{real(0.01, 1)};
      case 1:
        return Box{{real(0.01, 1), real(0.01, 1), real(0.01, 1)}};
      case 2:
        return Capsule{real(0.01, 1), real(0.01, 1)};
      case 3:
        return Cylinder{real(0.01, 1), real(0.01, 1)};
      case 4:
        return Hull{randomHull(random_, 4 + whole(40)), whole(2) == 0 ? 1 : real(0.2, 3), ""};
      case 5:
        return Mesh{dentedTetrahedron(real(0.5, 2)), whole(2) == 0 ? 1 : real(0.2, 3), ""};
      default:
        break;
    }
    Compound compound;
    for (int parts = 1 + whole(4); parts > 0; --parts)
      compound.parts.push_back({shape(depth + 1), whole(3) == 0 ? Vec3(Vec3::Zero()) : vector(0.5), turn()});
    return compound;
  }

  Body body(const std::string& name) {
    Body out = bodyOf(name, shape(0), vector(20));
    out.orientation = turn();
    out.fixed = whole(4) == 0;
    if (out.fixed && out.position.x() > 0)
      out.surface_velocity = 0.3 * out.position, out.surface_angular_velocity = {out.position.y(), 0.1, out.position.x()};
    if (out.fixed) return out;
    out.velocity = vector(10), out.angular_velocity = vector(20);
    (whole(2) == 0 ? out.mass : out.density) = real(0.1, 2000);
    if (whole(3) == 0) out.center_of_mass = vector(0.1);
    const Vec3 semiaxes(real(0.1, 1), real(0.1, 1), real(0.1, 1));  // of an ellipsoid, whose moments are possible ones
    const Vec3 squares = semiaxes.cwiseAbs2();
    const Vec3 moments = Vec3::Constant(squares.sum()) - squares;
    if (whole(3) == 0) out.inertia = Inertia::fromMoments(moments);
    const Mat3 R = turn().toRotationMatrix();
    const Mat3 tensor = R * moments.asDiagonal() * R.transpose();
    if (whole(3) == 0) out.inertia = Inertia::fromMatrix((tensor + tensor.transpose()) / 2);
    return out;
  }

 private:
  std::mt19937 random_;
};

}  // namespace

Document randomDocument(std::uint32_t seed) {
  RandomBodies random(seed);
  Document document;
  for (int i = 0; i < 12; ++i) document.scene.bodies.push_back(random.body("body " + std::to_string(i)));
  document.scene.gravity = random.vector(10);
  document.duration = random.real(0.1, 3);
  return document;
}

}  // namespace carom::import_tests
