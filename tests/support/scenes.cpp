// SPDX-License-Identifier: MIT
#include "tests/support/scenes.h"

#include <cmath>
#include <numbers>

#include "adjoint/numeric/so3.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::test {

Material makeMaterial(const std::string& name, double elasticity, double friction, double tangential) {
  Material m;
  m.name = name, m.elasticity = elasticity, m.friction = friction, m.tangential_elasticity = tangential;
  return m;
}

namespace {

Body makeBody(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity) {
  Body b;
  b.name = name, b.material = "m", b.mass = 1;
  b.shape = shape;
  b.position = position, b.velocity = velocity;
  return b;
}

}  // namespace

Body makePlane(const std::string& name, const Vec3& normal, double offset) {
  return fixedBody(makeBody(name, Plane{normal, offset}, Vec3::Zero(), Vec3::Zero()));
}

Body makeBall(const std::string& name, double radius, const Vec3& position, const Vec3& velocity) {
  return makeBody(name, Sphere{radius}, position, velocity);
}

Body makeBox(const std::string& name, const Vec3& size, const Vec3& position, const Vec3& velocity) {
  return makeBody(name, Box{size}, position, velocity);
}

Body fixedBody(Body body) {
  body.fixed = true;
  body.mass.reset();
  body.velocity.setZero();
  return body;
}

Shape shapeOfBoxes(const std::vector<std::pair<Vec3, Vec3>>& boxes) {
  Compound compound;
  for (const auto& [size, at] : boxes) {
    CompoundPart part;
    part.shape = Box{size};
    part.position = at;
    compound.parts.push_back(part);
  }
  return compound;
}

Scene makeScene(const Vec3& gravity, double elasticity, double friction, std::vector<Body> bodies) {
  Scene s;
  s.gravity = gravity;
  s.materials = {makeMaterial("m", elasticity, friction)};
  s.bodies = std::move(bodies);
  return s;
}

Motion play(const Scene& scene, double duration, std::size_t impact_limit) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = impact_limit;
  return simulate(scene, contacts, duration, options);
}

Vec3 Random::unit() {
  const double z = in(-1, 1), angle = in(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Quat Random::rotation() {
  const Vec3 axis = unit();
  return Quat(Eigen::AngleAxisd(in(0, std::numbers::pi), axis));
}

Eigen::VectorXd Random::vector(Eigen::Index n) {
  Eigen::VectorXd v(n);
  for (double& x : v) x = in(-1, 1);
  return v;
}

Scene randomScene(std::uint64_t seed, const RandomScene& o) {
  Random random(seed);
  Scene s;
  s.gravity = o.gravity ? Vec3(0.4, -0.3, -9.81) : Vec3::Zero();
  const auto material = [&](const char* name) {
    // arguments of a call are made in an order that the compiler chooses
    const double tangential = o.friction ? random.in(-o.tangential, o.tangential) : 0;
    const double friction = o.friction ? random.in(0.02, 0.9) : 0;
    return makeMaterial(name, random.in(o.lowest_elasticity, 1), friction, tangential);
  };
  s.materials = {material("m"), material("other")};
  for (int i = 0; i < o.bodies; ++i) {
    // cells of a grid that is wider than any of the bodies, so that none overlap
    const Vec3 cell(i % 2, i / 2 % 2, i / 4), at = 0.8 * cell + random.vec(0.04) + Vec3(0, 0, 0.6);
    const Vec3 centre(0.4, 0.4, 0.6);
    const Vec3 aside = random.vec(0.4), velocity = random.in(1, 3) * (centre - at) + aside;
    const std::string name = "body" + std::to_string(i);
    Body b = random.in(0, 1) < 0.3 ? makeBall(name, random.in(0.1, 0.3), at, velocity)
                                   : makeBox(name, Vec3(0.25, 0.25, 0.25) + random.vec(0.13), at, velocity);
    if (random.in(0, 1) < 0.5) b.material = "other";
    b.mass = random.in(0.3, 3);
    b.orientation = random.rotation();
    b.angular_velocity = random.vec(5);
    s.bodies.push_back(b);
  }
  if (o.floor) s.bodies.push_back(makePlane("floor", Vec3::UnitZ(), 0));
  return s;
}

SceneTangent randomDirection(const Scene& scene, Random& random) {
  SceneTangent d(scene);
  d.gravity = random.vec(1);
  for (MaterialDerivative& m : d.materials) m = {random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)};
  for (BodyDerivative& b : d.bodies) {
    b.position = random.vec(1), b.orientation = random.vec(1);
    b.velocity = random.vec(1), b.angular_velocity = random.vec(1);
    b.mass = random.in(-1, 1), b.density = random.in(-1, 1);
    b.inertia = random.vec(1);
    for (double& size : b.size) size = random.in(-1, 1);
  }
  for (Vec2& t : d.tilts) t = random.vec(1).head<2>();
  if (std::ranges::none_of(scene.bodies, &Body::surfaceMoves)) return d;  // what lasts on them has no such derivative
  Random of_surfaces(static_cast<std::uint64_t>(1e9 * (1 + d.gravity.x())));  // those above stay what they are
  for (BodyDerivative& b : d.bodies) b.surface_velocity = of_surfaces.vec(1), b.surface_angular_velocity = of_surfaces.vec(1);
  return d;
}

StateSeed seedOf(int body, const Instant& at, int i) {
  StateSeed seed;
  seed.body = body;
  seed.at = at;
  Vec3* const parts[] = {&seed.position, &seed.orientation, &seed.velocity, &seed.angular_velocity};
  (*parts[i / 3])[i % 3] = 1;
  return seed;
}

StateSeed randomSeed(int body, const Instant& at, Random& random) {
  StateSeed seed;
  seed.body = body;
  seed.at = at;
  seed.position = random.vec(1), seed.orientation = random.vec(1);
  seed.velocity = random.vec(1), seed.angular_velocity = random.vec(1);
  if (at.event >= 0) seed.time = random.in(-1, 1);
  return seed;
}

StateSeed randomSeedOfScene(const Scene& scene, int body, const Instant& at, Random& random) {
  StateSeed seed = randomSeed(body, at, random);
  const Shape& shape = scene.bodies[static_cast<std::size_t>(body)].shape;
  seed.mass = random.in(-1, 1);
  for (double& weight : seed.inertia.reshaped()) weight = random.in(-1, 1);
  seed.size = random.vector(kindOf(shape).dimensions(shape).size());
  seed.gravity = random.vec(1);
  return seed;
}

SceneGradient gradientOf(const Motion& motion, int body, double time, int i) {
  const StateSeed seed = seedOf(body, Instant::at(time), i);
  return adjoint(motion, std::span(&seed, 1));
}

Eigen::VectorXd flatten(const SceneDerivative& d) {
  std::vector<double> all(d.gravity.data(), d.gravity.data() + 3);
  for (const MaterialDerivative& m : d.materials)
    all.insert(all.end(), {m.elasticity, m.friction, m.tangential_elasticity});
  for (const BodyDerivative& b : d.bodies) {
    for (const Vec3* v : {&b.position, &b.orientation, &b.velocity, &b.angular_velocity, &b.inertia, &b.surface_velocity,
                          &b.surface_angular_velocity})
      all.insert(all.end(), v->data(), v->data() + 3);
    all.insert(all.end(), b.size.begin(), b.size.end());
    all.insert(all.end(), {b.mass, b.density});
  }
  for (const Vec2& t : d.tilts) all.insert(all.end(), {t.x(), t.y()});
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

Eigen::Matrix<double, 13, 1> flatten(const BodyState& s) {
  Eigen::Matrix<double, 13, 1> all;
  all << s.position, s.orientation.coeffs(), s.velocity, s.angular_velocity;
  return all;
}

double kineticEnergy(const BodyModel& model, const State& s) {
  const Vec3 M = s.q.toRotationMatrix().transpose() * s.L;
  return 0.5 * (model.mass * s.v.squaredNorm() + M.cwiseAbs2().dot(model.inverse_inertia));
}

Vec3 angularMomentum(const BodyModel& model, const State& s) { return s.L + s.x.cross(model.mass * s.v); }

Scene moved(Scene s, const SceneTangent& d, double h) {
  s.gravity += h * d.gravity;
  for (std::size_t m = 0; m < s.materials.size(); ++m) {
    s.materials[m].elasticity += h * d.materials[m].elasticity;
    s.materials[m].friction += h * d.materials[m].friction;
    s.materials[m].tangential_elasticity += h * d.materials[m].tangential_elasticity;
  }
  for (std::size_t i = 0; i < s.bodies.size(); ++i) {
    Body& b = s.bodies[i];
    const BodyDerivative& r = d.bodies[i];
    if (b.immovable())
      b.surface_velocity += h * r.surface_velocity, b.surface_angular_velocity += h * r.surface_angular_velocity;
    b.position += h * r.position, b.velocity += h * r.velocity, b.angular_velocity += h * r.angular_velocity;
    b.orientation = (adjoint_detail::expSO3(h * r.orientation) * b.orientation).normalized();
    if (b.mass) *b.mass += h * r.mass;
    if (b.density) *b.density += h * r.density;
    const ShapeKind& kind = kindOf(b.shape);
    if (r.size.size() > 0) kind.setDimensions(b.shape, kind.dimensions(b.shape) + h * r.size);
  }
  return s;
}

}  // namespace carom::test
