// SPDX-License-Identifier: MIT
// Derivatives through bodies that move on each other (docs/equations.md, 11.37): closed forms, differences of eighth order, tangent
// against adjoint, both orders of the bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/base/errors.h"
#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "tests/support/compare.h"
#include "tests/support/group_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::group_derivatives {
namespace {

using namespace test;
using namespace groups;

const BodyDerivative& of(const Scene& scene, const SceneGradient& g, const char* body) {
  return g.bodies[static_cast<std::size_t>(bodyIndex(scene, body))];
}

// Box m on plank M on ice: t = v M/((M + m) mu g), both go on at V = v m/(M + m), the plank is at X = V (T - t/2).
TEST(GroupDerivatives, ABoxOnAPlankOnIce) {
  const double m = 1, M = 4, v = 2, mu = 0.25, T = 1, t = v * M / ((M + m) * mu * kG), V = v * m / (M + m);
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(boxOnPlank(), reverse);
    const Motion motion = playGroups(scene, T);
    ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
    Reliability reliability;
    StateSeed seed;
    seed.body = bodyIndex(scene, "plank"), seed.at = Instant::at(T), seed.position = Vec3::UnitX();
    const SceneGradient d = adjoint(motion, std::span(&seed, 1), &reliability);
    EXPECT_TRUE(reliability.reliable) << reliability.message;
    expectEntries(of(scene, d, "box").velocity.x(), V / v * (T - t / 2) - V * t / (2 * v), 1e-12, "by the velocity of the box");
    expectEntries(d.materials[0].friction, V * t / (2 * mu), 1e-11, "by friction");
    expectEntries(of(scene, d, "box").mass, V * (1 / m - 1 / (M + m)) * (T - t / 2) + V * t / (2 * (M + m)), 1e-12, "by its mass");
    expectEntries(of(scene, d, "plank").mass, -V / (M + m) * (T - t / 2) - V * t / 2 * (1 / M - 1 / (M + m)), 1e-12, "by that of the plank");
    expectEntries(of(scene, d, "plank").position.x(), 1, 1e-12, "by the place of the plank");
    expectEntries(of(scene, d, "box").position.x(), 0, 1e-12, "by that of the box");
    expectEntries(d.gravity.z(), -V * t / (2 * kG), 1e-12, "by gravity");
    StateSeed after;
    after.body = bodyIndex(scene, "box"), after.at = Instant::after(1), after.time = 1;
    const SceneGradient when = adjoint(motion, std::span(&after, 1));
    expectEntries(of(scene, when, "box").velocity.x(), t / v, 1e-12, "when, by the velocity");
    expectEntries(when.materials[0].friction, -t / mu, 1e-11, "when, by friction");
    expectTransposed(motion, 1);
  }
}

// A ball without spin on a box of M: rolls at t = 2 v/(mu g (7 + 2/M')) ..., M' = M/m; its velocity then is v - mu g t.
TEST(GroupDerivatives, ABallRollsOnABoxOnIce) {
  const double v = 2, mu = 0.3, M = 3, rate = 3.5 + 1 / M, t = v / (mu * kG * rate);
  for (const bool reverse : {false, true}) {
    const Scene scene = inOrder(ballOnBox(), reverse);
    const Motion motion = playGroups(scene, 1);
    ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
    StateSeed seed;
    seed.body = bodyIndex(scene, "ball"), seed.at = Instant::at(1), seed.velocity = Vec3::UnitX();
    const SceneGradient d = adjoint(motion, std::span(&seed, 1));
    expectEntries(of(scene, d, "ball").velocity.x(), 1 - 1 / rate, 1e-12, "by its velocity");
    expectEntries(of(scene, d, "box").velocity.x(), 1 / rate, 1e-12, "by that of the box");
    expectEntries(d.materials[0].friction, 0, 1e-12, "by friction");
    expectEntries(of(scene, d, "box").mass, -v / (rate * rate) / (M * M), 1e-12, "by the mass of the box");
    StateSeed after;
    after.body = seed.body, after.at = Instant::after(1), after.time = 1;
    expectEntries(adjoint(motion, std::span(&after, 1)).materials[0].friction, -t / mu, 1e-11, "when, by friction");
    expectTransposed(motion, 2);
  }
}

// The reliable columns of a group's gradients are those of differences of eighth order, the same with bodies in reverse order, and nothing
// changes as they are taken.
TEST(GroupDerivatives, AreThoseOfDifferences) {
  for (const GroupCase& c : groupCases()) {
    SCOPED_TRACE(c.name);
    const Motion m = playGroups(c.scene, c.until);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const Motion reversed = playGroups(inOrder(c.scene, true), c.until);
    const BodyState before = m.stateAt(c.body, c.until);
    Random random(7);
    const SceneTangent all = randomDirection(c.scene, random);
    DerivativeTape tape(m), of_reversed(reversed);
    expectTransposed(m, 3, 1e-12);
    int compared = 0;
    for (const ControlRow& control : controlRows()) {
      const std::string name = control.name;
      if (name == "elasticity" || name == "tilt" || name == "tangential_elasticity" || name == "density" || name == "surface_velocity" || name == "surface_angular_velocity") continue;
      SCOPED_TRACE(name);
      SceneTangent d(c.scene);
      control.copy(d, all);
      if (c.along) c.along(d);
      d.materials[1].friction = 0;  // ice has none
      const BodyStateRate r = tangent(tape, d).at(c.body, Instant::at(c.until));
      Eigen::Matrix<double, 12, 1> found, difference = Eigen::Matrix<double, 12, 1>::Zero(), coarse = difference;
      found << r.position, r.orientation, r.velocity, r.angular_velocity;
      SceneTangent turned = d;
      std::ranges::reverse(turned.bodies);
      const BodyStateRate other = tangent(of_reversed, turned).at(static_cast<int>(c.scene.bodies.size()) - 1 - c.body, Instant::at(c.until));
      Eigen::Matrix<double, 12, 1> in_reverse;
      in_reverse << other.position, other.orientation, other.velocity, other.angular_velocity;
      const double size = std::max(found.cwiseAbs().maxCoeff(), 1e-3);
      expectEntries(in_reverse / size, found / size, c.order, "in reverse order");
      bool same = true;
      const double h = c.step;
      for (const int k : {1, 2, 3, 4, 6, 8})
        for (const int sign : {-1, 1}) {
          const Motion n = playGroups(moved(c.scene, d, sign * k * h), c.until);
          same = same && n.status == MotionStatus::complete && n.events.size() == m.events.size();
          if (!same) break;
          const auto change = changeOf(before, n.stateAt(c.body, c.until));
          if (k <= 4) difference += sign * kEighthOrder[k - 1] / h * change;
          if (k % 2 == 0) coarse += sign * kEighthOrder[k / 2 - 1] / (2 * h) * change;
        }
      if (!same) continue;
      const double unsure = (difference - coarse).cwiseAbs().maxCoeff() / size;
      if (!(unsure < 1e-7)) continue;
      ++compared;
      expectEntries(found / size, difference / size, 1e-9 + 3 * unsure, "against differences");
    }
    EXPECT_GE(compared, c.least) << "controls that could be compared";
    const BodyState after = m.stateAt(c.body, c.until);
    EXPECT_EQ(before.position, after.position);
    EXPECT_EQ(before.velocity, after.velocity);
  }
}

}  // namespace
}  // namespace carom::group_derivatives
