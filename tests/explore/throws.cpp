// SPDX-License-Identifier: MIT
#include "tests/explore/throws.h"

#include <algorithm>
#include <cmath>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom::explore_test {
namespace {

constexpr double kRadius = 0.05, kWallX = 2, kWallHalf = 0.05, kWallHeight = 0.8;
const Vec3 kStart(0, 0, 0.5);
constexpr double kForward = 3, kGravity = 9.81;

Target positionOf(TargetNumber x, TargetNumber y, TargetNumber z) { return {"position", {x, y, z}}; }

const TargetNumber kFree = any;

}  // namespace

Control drawn(Control control, Distribution distribution) {
  control.distribution = std::move(distribution);
  return control;
}

Exploration exploring(const Throw& t, const ExploreOptions& options) {
  OdeContacts contacts(t.scene);
  return Exploration(t.scene, contacts, t.duration, t.controls, t.constraints, options);
}

Throw bouncingBall() {
  Body ball = test::makeBall("ball", 0.05, {0, 0, 1}, {2, 0.1, 0.5});
  ball.angular_velocity = {1, 20, -3};
  Throw t{
      test::makeScene({0, 0, -kGravity}, 0.8, 0.3, {test::makePlane("floor", Vec3::UnitZ(), 0), ball}), 1.5, {}, {}};
  t.controls = {drawn(velocity("ball"), NormalDistribution{{}, {0.3, 0.2, 0.4}}),
                drawn(angularVelocity("ball"), NormalDistribution{{}, {}, {{1, 0}, {3, 4}, {0, 2}}}),
                drawn(elasticity("m"), UniformDistribution{{0.6}, {0.9}}),
                drawn(friction("m"), LogNormalDistribution{{0.3}, {0.2}}), mass("ball")};
  Constraint at{"ball", 1.2, {positionOf(2.5, kFree, kFree)}};
  Target range = positionOf(kFree, kFree, kFree);
  range.quantity = "velocity", range.min = {1.5, kFree, kFree}, range.max = {2.5, kFree, kFree};
  at.targets.push_back(range);
  Constraint second{"ball", nthImpact(2), {{"time", {0.9}}}};
  t.constraints = {at, second};
  return t;
}

Throw tumblingBox() {
  Body box = test::makeBox("box", {0.3, 0.2, 0.1}, {0, 0, 1}, {1, 0.2, 0});
  box.angular_velocity = {3, -5, 2};
  Throw t{test::makeScene({0, 0, -kGravity}, 0.6, 0.4, {test::makePlane("floor", Vec3::UnitZ(), 0), box}), 0.8, {}, {}};
  t.controls = {drawn(orientation("box"), UniformOrientation{}),
                drawn(velocity("box").only({"x"}), NormalDistribution{{1}, {0.2}})};
  t.constraints = {{"box", 0.7, {positionOf(0.5, 0, kFree)}}};
  return t;
}

Throw ballOverWall() {
  Body wall = test::fixedBody(test::makeBox("wall", {2 * kWallHalf, 4, 6}, {kWallX, 0, kWallHeight - 3}));
  Body ball = test::makeBall("ball", kRadius, kStart, {kForward, 0, kMeanSpeed});
  Throw t{test::makeScene({0, 0, -kGravity}, 0.5, 0.2, {wall, ball}), 0.8, {}, {}};
  t.controls = {drawn(velocity("ball").only({"z"}), NormalDistribution{{}, {kSpeedDeviation}})};
  Constraint beyond{"ball", 0.8, {positionOf(kFree, kFree, kFree)}};
  beyond.targets[0].min = {2.2, kFree, kFree};
  t.constraints = {beyond};
  return t;
}

namespace {

/// The least distance of the parabola from the upper edges of the wall and its top, less the radius.
double clearance(double vz) {
  double least = 1e9;
  const auto at = [&](double t) {
    const double x = kForward * t, z = kStart.z() + vz * t - kGravity * t * t / 2;
    const double dx = std::max({kWallX - kWallHalf - x, x - kWallX - kWallHalf, 0.0}), dz = z - kWallHeight;
    return dz < 0 ? dx : std::hypot(dx, dz);
  };
  // Samples, then golden sections about the least of them.
  const double from = (kWallX - 0.3) / kForward, to = (kWallX + 0.3) / kForward, step = (to - from) / 2000;
  double best = from;
  for (double t = from; t <= to; t += step)
    if (at(t) < least) least = at(t), best = t;
  double a = best - step, b = best + step;
  for (int k = 0; k < 100; ++k) {
    const double s = a + 0.381966 * (b - a), r = b - 0.381966 * (b - a);
    (at(s) < at(r) ? b : a) = at(s) < at(r) ? r : s;
  }
  return std::min(least, at((a + b) / 2)) - kRadius;
}

}  // namespace

double clearingSpeed() {
  double below = 0, above = 10;
  for (int k = 0; k < 60; ++k) (clearance((below + above) / 2) < 0 ? below : above) = (below + above) / 2;
  return above;
}

Throw droppedDie() {
  Body die = test::makeBox("die", {0.02, 0.02, 0.02}, {0, 0, 0.1}, {0.1, 0, 0});
  die.mass = 0.02;
  die.angular_velocity = {7, 11, -5};
  Throw t{test::makeScene({0, 0, -kGravity}, 0.3, 0.4, {test::makePlane("floor", Vec3::UnitZ(), 0), die}), 1, {}, {}};
  t.controls = {drawn(orientation("die"), UniformOrientation{})};
  return t;
}

}  // namespace carom::explore_test
