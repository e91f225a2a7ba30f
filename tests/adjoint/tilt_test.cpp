// SPDX-License-Identifier: MIT
// The axes of a tilt: smooth where surfaces are, with one direction that has none; and motions that bounce off tilted
// normals of floors that turn.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/impact/tilt.hpp"
#include "adjoint/impact/tilt_frame.hpp"
#include "adjoint/numeric/so3.hpp"
#include "tests/adjoint/tolerances.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;
using Frame = adjoint_detail::TiltFrame<double>;

TEST(TiltAxes, AreOrthonormalEverywhere) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Vec3 n = random.unit();
    const Frame frame(n);
    Mat3 axes;
    axes << frame.t1, frame.t2, n;
    expectEntries(axes.transpose() * axes, Mat3::Identity(), 1e-14, "axes");
    expectEntries(axes.determinant(), 1, 1e-14, "t2 = n x t1");
  }
}

// Turning a normal by a little turns its axes by a little, within the bound that tiltMargin gives; 2 at the most from
// floors and walls but 9 at a ceiling.
TEST(TiltAxes, TurnWithTheNormal) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Vec3 n = random.unit();
    if (seed % 2) {
      n = Vec3(random.below(3) - 1, random.below(3) - 1, random.below(3) - 1);
      if (n.norm() == 0) continue;
      n.normalize();
      EXPECT_GT(tiltMargin(n, true, true), std::sin(27 * 3.14159265 / 360)) << n.transpose();
    }
    const Vec3 turn = 1e-9 * random.unit(), moved = (n + turn.cross(n)).normalized();
    const double change = (Frame(moved).t1 - Frame(n).t1).norm();
    EXPECT_TRUE(change <= 1.01e-9 * std::max(1.0, 1 / tiltMargin(n, true, false)) + 1e-15) << change;
  }
}

TEST(TiltAxes, OfALevelFloorLieAlongTheWorlds) {
  expectEntries(Frame(Vec3::UnitZ()).t1, Vec3::UnitY(), 1e-15, "t1");
  expectEntries(Frame(Vec3::UnitZ()).t2, Vec3(-Vec3::UnitX()), 1e-15, "t2");
}

/// A ball on a floor that can turn about a line 0.3 m aside, its bounce tilted.
Scene turned(const Vec3& turn) {
  Scene scene = makeScene({0, 0, -10}, 0.5, 0,
                          {makePlane("floor", Vec3::UnitZ(), -1), makeBall("ball", 0.1, {0.3, 0, 0}, {0, 0, 0})});
  scene.tilts.push_back({"ball", 1, {0.03, 0.01}});
  scene.bodies[0].orientation = expSO3(turn);
  return scene;
}

TEST(TiltedBounce, MovesAsLittleAsItsFloorTurns) {
  const Vec3 level = play(turned(Vec3::Zero()), 0.6).stateAt("ball", 0.6).position;
  for (int i = 0; i < 3; ++i)
    for (double angle : {1e-9, -1e-9, 1e-6, -1e-6}) {
      const Vec3 moved = play(turned(angle * Vec3::Unit(i)), 0.6).stateAt("ball", 0.6).position;
      EXPECT_TRUE((moved - level).norm() <= 10 * std::abs(angle)) << i << " " << angle << ": " << (moved - level).norm();
    }
}

// Against differences of fourth order over the motion itself, which is smooth now: their error is 1e-9 here.
TEST(TiltedBounce, HasTheDerivativeByTheTurnOfItsFloor) {
  const Motion m = play(turned(Vec3::Zero()), 0.6);
  const double h = 1e-3;
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](double s) { return flatten(play(turned(s * h * Vec3::Unit(i)), 0.6).stateAt("ball", 0.6)); };
    const Eigen::Matrix<double, 13, 1> difference = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
    for (int k : {0, 1, 2}) {
      const double found = gradientOf(m, 1, 0.6, k).bodies[0].orientation[i];
      expectEntries(found, difference[k], 1e-8, "d position");
      const double v = gradientOf(m, 1, 0.6, 6 + k).bodies[0].orientation[i];
      expectEntries(v, difference[7 + k], 1e-8, "d velocity");
    }
  }
}

TEST(TiltedBounce, IsMarkedNearTheDirectionWithoutAxes) {
  const Vec3 bad = -Vec3(0.282, -0.367, 0.886).normalized();
  for (const auto& [angle, reliable] : {std::pair(1e-5, false), std::pair(1e-2, true)}) {
    const Vec3 n = expSO3(angle * bad.unitOrthogonal()) * bad;
    Scene scene = makeScene(Vec3::Zero(), 0.5, 0, {makePlane("wall", n, -1), makeBall("ball", 0.1, {0, 0, 0}, -n)});
    scene.tilts.push_back({"ball", 1, {0.03, 0.01}});
    const Motion m = play(scene, 1.5);
    ASSERT_EQ(m.events.size(), 1u);
    StateSeed seed = seedOf(1, Instant::at(1.5), 0);
    Reliability r;
    adjoint(m, std::span(&seed, 1), &r);
    EXPECT_EQ(r.reliable, reliable) << r.message;
    if (!reliable) {
      EXPECT_NE(r.message.find("in which tilt axes are undefined"), std::string::npos) << r.message;
    }
  }
}

}  // namespace
}  // namespace carom
