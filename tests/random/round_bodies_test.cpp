// SPDX-License-Identifier: MIT
// Capsules, cylinders and cones that roll over the edge of a box at any angle, and coins: they never overlap what they
// roll on, contacts stay closed and energy does not grow, or a sentence says why the motion ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "adjoint/motion/body_geometry.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/constrained_checks.h"
#include "tests/support/scaled.h"
#include "tests/support/scenes.h"

namespace carom::round_bodies {
namespace {

using namespace test;

constexpr double kDeepest = 1e-9;  // of the size of the body
constexpr double kGrowth = 1e-12;  // J/kg
constexpr double kOpen = 1e-12;    // m
constexpr int kLooks = 20;         // of every arc

Shape roundShape(int kind, double radius, double height) {
  if (kind == 0) return Capsule{radius, height};
  if (kind == 1) return Cylinder{radius, height};
  return Cone{radius, height};
}

// On its side, or with its axis level and so about to fall onto its side, before an edge along y; a floor lies below.
Scene overAnEdge(int kind, double radius, double height, double yaw, double speed, double elasticity, double friction) {
  Body body = makeBall("body", radius, Vec3::Zero());
  body.shape = roundShape(kind, radius, height);
  const Quat turn(Eigen::AngleAxisd(yaw, Vec3::UnitZ()));
  body.orientation = turn * Quat(Eigen::AngleAxisd(-std::acos(0.0), Vec3::UnitX()));
  body.position = {0.3, 0, kind == 2 ? radius + 0.01 : radius};
  body.velocity = speed * (turn * Vec3::UnitX());
  body.angular_velocity = Vec3::UnitZ().cross(body.velocity) / radius;
  const Body table = fixedBody(makeBox("table", {1, 2, 1}, {0, 0, -0.5}));
  return makeScene({0, 0, -9.81}, elasticity, friction, {body, table, makePlane("floor", Vec3::UnitZ(), -3)});
}

Motion play(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = 100000;
  options.step_limit = 3'000'000;
  return simulate(scene, contacts, duration, options);
}

double deepestOverlap(const Motion& m) {
  const auto& geometry = dynamic_cast<const BodyGeometry&>(*m.geometry);
  const auto& arcs = m.world_lines[0].arcs;
  double deepest = 0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const double start = arcs[i].start(), end = i + 1 < arcs.size() ? arcs[i + 1].start() : m.end;
    for (int s = 0; s <= kLooks; ++s) {
      const double t = start + (end - start) * s / kLooks;
      const Kinematics k = arcs[i].kinematicsAt(t);
      for (std::size_t b = 1; b < m.world_lines.size(); ++b) {
        const Kinematics o = m.world_lines[b].arcs.back().kinematicsAt(t);
        deepest = std::max(deepest, geometry.overlap(0, static_cast<int>(b), {k.x, k.R}, {o.x, o.R}));
      }
    }
  }
  return deepest;
}

// Whether the motion came to its end; it is right as far as it goes in any case.
bool holdsAll(const Motion& m) {
  const Shape& shape = m.scene->bodies[0].shape;
  const double depth = deepestOverlap(m) / kindOf(shape).boundingRadius(shape);
  const ConstrainedFindings found = lookAtConstrainedPaths(m, 4);
  EXPECT_TRUE(depth <= kDeepest) << depth << " of the size; " << m.message;
  EXPECT_TRUE(found.worst_gap <= kOpen) << found.worst_gap;
  EXPECT_TRUE(found.worst_growth <= kGrowth) << found.worst_growth;
  EXPECT_EQ(m.message.empty() || m.message == "complete", m.status == MotionStatus::complete) << m.message;
  return m.status == MotionStatus::complete;
}

// Its centre passes over the edge while one end still lies on the table: it tips about the point that is on the edge.
TEST(RoundBodies, ACapsuleThatRollsObliquelyTipsOverTheEdge) {
  const Motion m = play(overAnEdge(0, 0.1, 0.3, 0.3, 0.2, 0, 0.5), 3);
  EXPECT_TRUE(holdsAll(m)) << m.message;
  const double tips = 0.2 / (0.2 * std::cos(0.3));
  const bool lifts = std::ranges::any_of(m.events, [&](const Event& e) {
    return e.cause == TransitionCause::lifts && std::abs(e.time - tips) <= 1e-9;
  });
  EXPECT_TRUE(lifts) << "no end lifts at " << tips;
}

TEST(RoundBodies, RollOverEdgesAtAnyAngle) {
  constexpr std::array<double, 4> bounces = {0, 0.2, 0.5, 0.85};
  constexpr std::array<double, 3> frictions = {0.1, 0.4, 0.9};
  for (int kind = 0; kind < 3; ++kind) {
    int count = 0, complete = 0;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(25)); ++seed) {
      SCOPED_TRACE("kind " + std::to_string(kind) + ", seed " + std::to_string(seed));
      Random random(seed);
      const double radius = random.in(0.05, 0.15), height = random.in(0.1, 0.5), yaw = random.in(-1.2, 1.2);
      const double speed = random.in(0.05, 0.5);
      const double e = bounces[static_cast<std::size_t>(random.below(4))];
      const double mu = frictions[static_cast<std::size_t>(random.below(3))];
      complete += holdsAll(play(overAnEdge(kind, radius, height, yaw, speed, e, mu), 3)) ? 1 : 0;
      ++count;
    }
    std::printf("kind %d: %d of %d to the end\n", kind, complete, count);
    EXPECT_GE(complete, 0.95 * count);
  }
}

// Coins roll and wobble for as long as nothing but friction without rolling resistance takes their energy.
TEST(RoundBodies, ThrownCoinsRollOnOrEndWithASentence) {
  int count = 0, complete = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(scaled(15)); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double radius = random.in(0.01, 0.05);
    Body coin = makeBall("coin", radius, {0, 0, radius * random.in(2, 8)}, random.vec(1));
    coin.shape = Cylinder{radius, radius * random.in(0.05, 0.4)};
    coin.orientation = random.rotation();
    coin.angular_velocity = random.vec(0.5) / radius;
    const Body floor = random.below(2) ? makePlane("floor", Vec3::UnitZ(), 0)
                                       : fixedBody(makeBox("floor", {40, 40, 1}, {0, 0, -0.5}));
    complete += holdsAll(play(makeScene({0, 0, -9.81}, random.in(0, 0.8), random.in(0.1, 0.9), {coin, floor}), 4)) ? 1 : 0;
    ++count;
  }
  std::printf("%d of %d coins to the end\n", complete, count);
  EXPECT_GE(complete, 0.9 * count);
}

}  // namespace
}  // namespace carom::round_bodies
