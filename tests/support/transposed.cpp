// SPDX-License-Identifier: MIT
#include "tests/support/transposed.h"

#include <algorithm>
#include <cmath>

#include "adjoint/numeric/so3.hpp"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom::test {
namespace {

// What a change of the dimensions does by the inertia that it changes: with the spin held, L changes by the same share,
// and the two turn the body to and fro by about as much as a change of the spin by that share does. The sum of both may
// be far smaller than they are; their rounding is not. Dimensions are at most 1, so a share is at least d.size.
SceneTangent spinBySize(const Scene& scene, const SceneTangent& d) {
  SceneTangent spin(scene);
  const auto largest = [](const Eigen::VectorXd& v) { return v.size() == 0 ? 0.0 : v.cwiseAbs().maxCoeff(); };
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    spin.bodies[b].angular_velocity = largest(d.bodies[b].size) * scene.bodies[b].angular_velocity;
  return spin;
}

// Without the coefficients of friction by which the rows of the seeds have no derivative.
SceneTangent whereDerivativesExist(DerivativeTape& tape, const std::vector<StateSeed>& seeds, SceneTangent d) {
  Reliability reliability;
  adjoint(tape, seeds, &reliability);
  for (int m : reliability.frictions) d.materials[static_cast<std::size_t>(m)].friction = 0;
  return d;
}

double absoluteSum(const BodyStateRate& r, const StateSeed& s) {
  return r.position.cwiseAbs().dot(s.position.cwiseAbs()) + r.orientation.cwiseAbs().dot(s.orientation.cwiseAbs()) +
         r.velocity.cwiseAbs().dot(s.velocity.cwiseAbs()) +
         r.angular_velocity.cwiseAbs().dot(s.angular_velocity.cwiseAbs()) + std::abs(r.time * s.time) +
         std::abs(r.mass * s.mass) + r.inertia.cwiseAbs().cwiseProduct(s.inertia.cwiseAbs()).sum() +
         r.gravity.cwiseAbs().dot(s.gravity.cwiseAbs()) +
         (r.size.size() > 0 && s.size.size() > 0 ? r.size.cwiseAbs().dot(s.size.cwiseAbs()) : 0);
}

double absoluteSum(const MotionTangent& t, const std::vector<StateSeed>& seeds) {
  double sum = 0;
  for (const StateSeed& seed : seeds) sum += absoluteSum(t.at(seed.body, seed.at), seed);
  return sum;
}

}  // namespace

double expectTransposed(DerivativeTape& tape, const SceneTangent& direction, const std::vector<StateSeed>& seeds,
                        double least, const std::string& what, double most) {
  const MotionTangent t = tangent(tape, direction);
  double lhs = 0;
  for (const StateSeed& seed : seeds) lhs += t.at(seed.body, seed.at).dot(seed);
  double size = least + absoluteSum(t, seeds);
  const SceneGradient g = adjoint(tape, seeds);
  const double rhs = g.dot(direction);
  size = std::max(size, flatten(g).cwiseAbs().dot(flatten(direction).cwiseAbs()));
  expectEntries(lhs / size, rhs / size, most, what);
  return size;
}

std::vector<int> movingBodies(const Scene& s) {
  std::vector<int> list;
  for (int b = 0; b < static_cast<int>(s.bodies.size()); ++b)
    if (!s.bodies[static_cast<std::size_t>(b)].fixed) list.push_back(b);
  return list;
}

Eigen::Matrix<double, 12, 1> changeOf(const BodyState& from, const BodyState& to) {
  Eigen::Matrix<double, 12, 1> change;
  change << to.position - from.position, adjoint_detail::logSO3(to.orientation * from.orientation.conjugate()), to.velocity - from.velocity,
      to.angular_velocity - from.angular_velocity;
  return change;
}

std::vector<ControlRow> controlRows() {
  std::vector<ControlRow> rows = {
      {"gravity", [](auto& to, const auto& from) { to.gravity = from.gravity; }},
      {"tilt", [](auto& to, const auto& from) { to.tilts = from.tilts; }},
  };
  const auto body = [&](const char* name, auto member) {
    rows.push_back({name, [member](auto& to, const auto& from) {
                      for (std::size_t b = 0; b < to.bodies.size(); ++b) to.bodies[b].*member = from.bodies[b].*member;
                    }});
  };
  body("position", &BodyDerivative::position);
  body("orientation", &BodyDerivative::orientation);
  body("velocity", &BodyDerivative::velocity);
  body("angular_velocity", &BodyDerivative::angular_velocity);
  body("surface_velocity", &BodyDerivative::surface_velocity);
  body("surface_angular_velocity", &BodyDerivative::surface_angular_velocity);
  body("mass", &BodyDerivative::mass);
  body("density", &BodyDerivative::density);
  body("inertia", &BodyDerivative::inertia);
  body("size", &BodyDerivative::size);
  const auto material = [&](const char* name, auto member) {
    rows.push_back({name, [member](auto& to, const auto& from) {
                      for (std::size_t m = 0; m < to.materials.size(); ++m)
                        to.materials[m].*member = from.materials[m].*member;
                    }});
  };
  material("elasticity", &MaterialDerivative::elasticity);
  material("friction", &MaterialDerivative::friction);
  material("tangential_elasticity", &MaterialDerivative::tangential_elasticity);
  return rows;
}

void expectTransposed(const Motion& motion, std::uint64_t seed, double most) {
  const Scene& scene = *motion.scene;
  DerivativeTape tape(motion);
  Random random(seed);
  const SceneTangent everything = randomDirection(scene, random);
  std::vector<StateSeed> at_times, at_impacts;
  for (int b : movingBodies(scene)) {
    at_times.push_back(randomSeed(b, Instant::at(random.in(0, motion.end)), random));
    at_times.push_back(randomSeed(b, Instant::at(motion.end), random));
    for (int n = 1; n <= 2; ++n)
      if (const auto e = motion.findImpact(b, n)) at_impacts.push_back(randomSeed(b, Instant::before(*e), random));
  }
  std::vector<StateSeed> of_scene;
  for (int b : movingBodies(scene)) {
    of_scene.push_back(randomSeedOfScene(scene, b, Instant::at(random.in(0, motion.end)), random));
    if (const auto e = motion.findImpact(b, 1))
      of_scene.push_back(randomSeedOfScene(scene, b, Instant::after(*e), random));
    if (!motion.events.empty())
      of_scene.push_back(randomSeed(b, Instant::after(static_cast<int>(motion.events.size()) - 1), random));
  }
  for (const auto& [seeds, when] : {std::pair{&at_times, ", at times"}, std::pair{&at_impacts, ", at impacts"},
                                    std::pair{&of_scene, ", of the scene and after impacts"}}) {
    const SceneTangent all = whereDerivativesExist(tape, *seeds, everything);
    // some derivatives are 0 (a lone body's by its mass) and cannot be held to their own size
    const double least = 1e-2 * expectTransposed(tape, all, *seeds, 1e-12, std::string("everything") + when, most);
    for (const ControlRow& control : controlRows()) {
      SceneTangent d(scene);
      control.copy(d, all);
      double parts = least;
      if (std::string(control.name) == "size") parts += absoluteSum(tangent(tape, spinBySize(scene, d)), *seeds);
      expectTransposed(tape, d, *seeds, parts, control.name + std::string(when), most);
    }
  }
}

}  // namespace carom::test
