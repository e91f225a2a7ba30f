// SPDX-License-Identifier: MIT
#include "tests/support/group_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/motion/body_geometry.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom::groups {

using namespace test;

Motion playGroups(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.groups = true;
  return simulate(scene, contacts, duration, options);
}

Scene inOrder(Scene scene, bool reverse) {
  if (reverse) std::ranges::reverse(scene.bodies);
  return scene;
}

double energyOf(const Motion& m, double t) {
  double energy = 0;
  for (std::size_t b = 0; b < m.world_lines.size(); ++b) {
    const BodyModel& model = (*m.models)[b];
    if (!model.moving || model.kinematic) continue;
    const BodyState s = m.stateAt(static_cast<int>(b), t);
    const Mat3 R = s.orientation.toRotationMatrix();
    energy += 0.5 * model.mass * s.velocity.squaredNorm() - model.mass * m.scene->gravity.dot(s.position);
    const Vec3 w = R.transpose() * s.angular_velocity;
    energy += 0.5 * w.dot(model.inertia.cwiseProduct(w));
  }
  return energy;
}

Kept keptBy(const Motion& m, int looks) {
  const auto* geometry = dynamic_cast<const BodyGeometry*>(m.geometry.get());
  Kept kept;
  double before = energyOf(m, 0);
  const double size = 1 + std::abs(before);
  const int count = static_cast<int>(m.world_lines.size());
  for (int i = 1; i <= looks; ++i) {
    const double t = std::min(m.end, m.end * i / looks), energy = energyOf(m, t);
    kept.gain = std::max(kept.gain, (energy - before) / size);
    before = energy;
    const auto pose = [&](int body) {
      const BodyState s = m.stateAt(body, t);
      return Pose{s.position, s.orientation.toRotationMatrix()};
    };
    for (int a = 0; a < count; ++a)
      for (int b = a + 1; b < count; ++b) kept.deepest = std::max(kept.deepest, geometry->overlap(a, b, pose(a), pose(b)));
  }
  return kept;
}

Scene sceneOf(double friction, std::vector<Body> bodies, const Vec3& gravity) {
  Scene scene = makeScene(gravity, 0, friction, std::move(bodies));
  scene.materials[0].friction = friction;
  Material ice = scene.materials[0];
  ice.name = "ice", ice.friction = 0;
  scene.materials[0].combine_friction = ice.combine_friction = Combine::minimum;
  scene.materials.push_back(ice);
  return scene;
}

Body onIce(Body body) {
  body.material = "ice";
  return body;
}
Body iceFloor() { return onIce(fixedBody(makeBox("floor", {40, 40, 1}, {0, 0, -0.5}))); }
Body withMass(Body body, double mass) {
  body.mass = mass;
  return body;
}

Scene boxOnPlank() {
  return sceneOf(0.25, {iceFloor(), withMass(makeBox("plank", {6, 1, 0.1}, {1, 0, 0.05}), 4),
                        withMass(makeBox("box", {0.2, 0.2, 0.2}, {0, 0, 0.2}, {2, 0, 0}), 1)});
}

Scene ballOnBox() {
  return sceneOf(0.3, {iceFloor(), withMass(makeBox("box", {6, 1, 0.2}, {1, 0, 0.1}), 3), withMass(makeBall("ball", 0.1, {0, 0, 0.3}, {2, 0, 0}), 1)});
}

namespace {

Body rollerAt(const char* name, double x) {
  Body body = withMass(makeBox(name, {1, 1, 1}, {x, 0, 0.1}), 1);
  body.shape = Cylinder{0.1, 0.4};
  body.orientation = Quat(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
  return body;
}

}  // namespace

Scene plankOnRollers() {
  const double a = 0.1;
  return sceneOf(0.9, {fixedBody(makeBox("floor", {40, 40, 1}, {0, 0, -0.5})), rollerAt("back", -0.5), rollerAt("front", 0.5),
                       withMass(makeBox("plank", {3, 0.4, 0.1}, {0, 0, 0.25}), 2)},
                 kG * Vec3(std::sin(a), 0, -std::cos(a)));
}

Scene dominoRow(int count) {
  std::vector<Body> bodies = {fixedBody(makeBox("floor", {4, 4, 1}, {0, 0, -0.5}))};
  for (int i = 0; i < count; ++i) bodies.push_back(withMass(makeBox("d" + std::to_string(i), {0.01, 0.03, 0.05}, {0.03 * i, 0, 0.025}), 0.02));
  bodies[1].angular_velocity = {0, 9, 0};
  bodies[1].velocity = Vec3(0, 9, 0).cross(Vec3(-0.005, 0, 0.025));
  return makeScene(kDown, 0.2, 0.4, bodies);
}

namespace {

// A ball that runs over a box on ice with a spin of its own: its slip turns, and ends.
Scene spinningBall() {
  Scene scene = ballOnBox();
  scene.bodies[2].velocity = {1.1, 0.4, 0};
  scene.bodies[2].angular_velocity = {3, -4, 2};
  return scene;
}

// Three balls, smooth, of different sizes, one on two: its centre is at the distances from theirs.
Scene threeBalls() {
  const double left = 0.5, right = 0.45, top = 0.4, apart = 0.9;
  const double a = left + top, b = right + top, rise = right - left, base = std::hypot(apart, rise);
  const double along = (base * base + a * a - b * b) / (2 * base), up = std::sqrt(a * a - along * along);
  const Vec3 e(apart / base, 0, rise / base), n(-rise / base, 0, apart / base), at = Vec3(0, 0, left) + along * e + up * n;
  return sceneOf(0.4, {iceFloor(), onIce(withMass(makeBall("left", left, {0, 0, left}), 1)), onIce(withMass(makeBall("right", right, {apart, 0, right}), 1.2)),
                       onIce(withMass(makeBall("top", top, at), 0.8))});
}

// A plate of 7 kg that leans on a smooth box of 2 kg on ice.
Scene leaningPlate() {
  const double a = 1.0, length = 2, thick = 0.02, height = 1.2;
  // its lower face touches the box's upper edge at x = 0, its lower corner the floor
  const Vec3 along(std::cos(a), 0, std::sin(a)), up(-std::sin(a), 0, std::cos(a));
  const Vec3 corner = Vec3(0, 0, height) - height / std::sin(a) * along;
  Body plate = onIce(withMass(makeBox("plate", {length, 0.5, thick}, Vec3(corner + length / 2 * along + thick / 2 * up)), 7));
  plate.orientation = Quat(Eigen::AngleAxisd(-a, Vec3::UnitY()));
  return sceneOf(0.3, {iceFloor(), onIce(withMass(makeBox("box", {1, 1, height}, {0.5, 0, height / 2}), 2)), plate});
}

}  // namespace

std::vector<GroupCase> groupCases() {
  // Bodies stay on each other: those that lie flat move along and turn about the vertical alone, and go up as what they lie on grows.
  const auto flat = [](SceneTangent& d) {
    double height = 0;
    for (BodyDerivative& b : d.bodies) {
      b.position.z() = b.velocity.z() = b.orientation.x() = b.orientation.y() = b.angular_velocity.x() = b.angular_velocity.y() = 0;
      if (&b == &d.bodies.front()) {
        b = BodyDerivative();
        b.size = Eigen::VectorXd::Zero(3);
        continue;
      }
      const bool ball = b.size.size() == 1;
      b.position.z() = height + (ball ? b.size[0] : b.size[2] / 2);
      height += ball ? 0 : b.size[2];
    }
    d.gravity.x() = d.gravity.y() = 0;
  };
  const auto balls = [flat](SceneTangent& d) {
    const BodyDerivative own = d.bodies.back();
    flat(d);
    d.bodies.back().orientation = own.orientation, d.bodies.back().angular_velocity = own.angular_velocity;
  };
  std::vector<GroupCase> cases;
  cases.push_back({"box on plank", boxOnPlank(), 2, 1, 1e-3, 5, 1e-11, flat});
  cases.push_back({"ball on box", ballOnBox(), 2, 1, 1e-3, 6, 1e-11, balls});
  cases.push_back({"spinning ball on box", spinningBall(), 2, 1, 1e-3, 6, 1e-11, balls});
  cases.push_back({"the box below a spinning ball", spinningBall(), 1, 1, 1e-3, 6, 1e-11, balls});
  // masses, moments, gravity and friction alone
  const auto causes = [](SceneTangent& d) {
    for (BodyDerivative& b : d.bodies) {
      BodyDerivative kept;
      kept.mass = b.mass, kept.inertia = b.inertia;
      kept.size = Eigen::VectorXd::Zero(b.size.size());
      b = kept;
    }
    d.gravity.y() = 0;
  };
  // the last one falls: it may do so otherwise, on one that rests there
  const auto falls = [flat](SceneTangent& d) {
    const BodyDerivative own = d.bodies.back();
    flat(d);
    d.bodies.back() = own;
    d.bodies[1].velocity.setZero(), d.bodies[1].angular_velocity.setZero();
  };
  cases.push_back({"three balls", threeBalls(), 3, 0.5, 1e-3, 2, 1e-11, causes});
  cases.push_back({"plank on rollers", plankOnRollers(), 3, 0.4, 1e-3, 2, 1e-11, causes});
  cases.push_back({"leaning plate", leaningPlate(), 2, 0.3, 1e-3, 2, 1e-11, causes});
  Scene dropped = spinningBall();
  dropped.bodies[2].position.z() += 0.05;
  cases.push_back({"dropped ball", dropped, 2, 1, 1e-3, 7, 1e-11, falls});
  cases.push_back({"box below a dropped ball", dropped, 1, 1, 1e-3, 7, 1e-11, falls});
  return cases;
}

}  // namespace carom::groups
