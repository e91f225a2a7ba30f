// SPDX-License-Identifier: MIT
// Joint impacts of bodies whose masses differ by up to 1e12, and of bodies that hardly resist a turn: motions whose
// answer is known, and their derivatives.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/adjoint/tolerances.h"
#include "tests/support/compare.h"
#include "tests/support/dot_product_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom {
namespace {

using namespace test;

Body ofMass(Body body, double mass) {
  body.mass = mass;
  return body;
}
Vec3 velocityAfter(const Motion& m, std::size_t event, int body) {
  const Event& e = m.events[event];
  const Participant* p = e.find(body);
  return m.world_lines[static_cast<std::size_t>(body)].arcs[static_cast<std::size_t>(p->next())].startState().v;
}

void expectRelative(double found, double right, double tolerance, const char* what) {
  EXPECT_TRUE(std::abs(found - right) <= tolerance * std::abs(right)) << what << ": " << found << " for " << right;
}

// Two balls that touch, the lower one lands: both go up as fast as they came down, whatever they weigh.
TEST(MassRatio, BallsThatTouchBounceTogether) {
  for (double upper : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (double lower : {1e-6, 1.0, 1e6}) {
      SCOPED_TRACE(std::to_string(lower) + " kg under " + std::to_string(upper) + " kg");
      const Scene s = makeScene({0, 0, -10}, 1, 0,
                                {ofMass(makeBall("low", 0.5, {0, 0, 1.5}), lower),
                                 ofMass(makeBall("high", 0.5, {0, 0, 2.5}), upper), makePlane("floor", Vec3::UnitZ(), 0)});
      const Motion m = play(s, 0.6);
      ASSERT_GE(m.events.size(), 1u);
      ASSERT_EQ(m.events[0].contacts.size(), 2u);
      const double speed = std::sqrt(20.0);
      expectEntries(velocityAfter(m, 0, 0), Vec3(0, 0, speed), 1e-12, "low", speed);
      expectEntries(velocityAfter(m, 0, 1), Vec3(0, 0, speed), 1e-12, "high", speed);
    }
}

// A ball runs into two that touch, which go on together: with M the sum of the masses, they get (1 + e) v m_a / M.
TEST(MassRatio, BallRunsIntoTwoThatTouch) {
  const double masses[] = {1e-6, 1e-2, 1, 1e6};
  for (double a : masses)
    for (double b : masses)
      for (double c : masses)
        for (double e : {0.0, 1e-9, 0.5, 1.0}) {
          SCOPED_TRACE("masses " + std::to_string(a) + ", " + std::to_string(b) + ", " + std::to_string(c) + ", e = " +
                       std::to_string(e));
          const double v = 1;
          const Scene s = makeScene(Vec3::Zero(), e, 0,
                                    {ofMass(makeBall("a", 0.1, {-0.5, 0, 0}, {v, 0, 0}), a),
                                     ofMass(makeBall("b", 0.1, {0, 0, 0}), b), ofMass(makeBall("c", 0.1, {0.2, 0, 0}), c)});
          const Motion m = play(s, 0.5, 1);
          ASSERT_EQ(m.events.size(), 1u);
          ASSERT_EQ(m.events[0].contacts.size(), 2u);
          const double M = a + b + c, shared = (1 + e) * v * a / M, rest = v * ((a - e * (b + c)) / M);
          EXPECT_TRUE(std::abs(velocityAfter(m, 0, 0).x() - rest) <= 1e-12) << velocityAfter(m, 0, 0).x() - rest;
          expectRelative(velocityAfter(m, 0, 1).x(), shared, 1e-12, "b");
          expectRelative(velocityAfter(m, 0, 2).x(), shared, 1e-12, "c");
          if (!(m.end > m.events[0].time)) continue;
          const SceneGradient g = gradientOf(m, 1, m.end, 6);
          // of the light one between heavy ones a derivative is the difference of terms that are 1e24 as large
          const double far = b <= a && b <= c ? 1e-7 : 1e-9;
          const double by_a = (1 + e) * v * (b + c) / (M * M), by_other = -(1 + e) * v * a / (M * M);
          expectRelative(g.bodies[0].mass, by_a, 1e-9, "by the mass of a");
          expectRelative(g.bodies[1].mass, by_other, far, "by the mass of b");
          expectRelative(g.bodies[2].mass, by_other, 1e-9, "by the mass of c");
          expectRelative(g.bodies[0].velocity.x(), (1 + e) * a / M, 1e-9, "by the speed");
          expectRelative(g.materials[0].elasticity, v * a / M, 1e-9, "by the elasticity");
        }
}

// A cube that hardly resists a turn lands flat as any other.
TEST(MassRatio, FlatCubeThatHardlyResistsATurn) {
  for (double moment : {1e-20, 1e-12, 1e-6, 1e12})
    for (double friction : {0.0, 0.5}) {
      SCOPED_TRACE("moments " + std::to_string(std::log10(moment)) + ", friction " + std::to_string(friction));
      Body cube = makeBox("cube", {1, 1, 1}, {0, 0, 1.5}, {1, 0, 0});
      cube.inertia = Inertia::fromMoments(Vec3::Constant(moment));
      const Motion m = play(makeScene({0, 0, -10}, 0.5, friction, {cube, makePlane("floor", Vec3::UnitZ(), 0)}), 0.6, 1);
      ASSERT_EQ(m.events.size(), 1u) << m.message;
      EXPECT_EQ(m.events[0].contacts.size(), 4u);
      const Vec3 after = velocityAfter(m, 0, 0);
      expectEntries(after.z(), 0.5 * std::sqrt(20.0), 1e-9, "up");
      EXPECT_TRUE(after.x() >= -1e-9 && after.x() <= 1 && std::abs(after.y()) <= 1e-9) << after.transpose();
      if (friction == 0) {
        expectEntries(after.x(), 1, 1e-9, "along");
        const State& s = m.world_lines[0].arcs[1].startState();
        EXPECT_TRUE((s.L / moment).norm() <= 1e-6) << (s.L / moment).transpose();
      }
    }
}

// Heavy on light on the floor, all of them plastic: everything stops, and rests.
TEST(MassRatio, HeavyBoxOnALightOne) {
  for (double light : {1e-6, 1e-3, 1.0})
    for (double heavy : {1.0, 1e3, 1e6, 1e9}) {
      SCOPED_TRACE(std::to_string(light) + " kg under " + std::to_string(heavy) + " kg");
      if (heavy / light > 1e12) continue;
      Scene s = makeScene({0, 0, -10}, 0, 0,
                          {ofMass(makeBox("low", {1, 1, 1}, {0, 0, 1.5}), light),
                           ofMass(makeBox("high", {0.6, 0.6, 1}, {0, 0, 2.5}), heavy), makePlane("floor", Vec3::UnitZ(), 0)});
      s.materials[0].tangential_elasticity = -1;
      const Motion m = play(s, 1);
      EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
      if (heavy / light < 1e12) EXPECT_EQ(m.events.size(), 1u);  // else speeds are left in rounding that take some more
      ASSERT_FALSE(m.events.empty());
      EXPECT_EQ(m.events[0].contacts.size(), 8u);
      for (int b : {0, 1}) {
        EXPECT_TRUE(velocityAfter(m, 0, b).norm() <= 1e-9) << velocityAfter(m, 0, b).transpose();
        EXPECT_EQ(m.world_lines[static_cast<std::size_t>(b)].arcs.back().kind(), ArcKind::rest);
      }
    }
}

// Rows of the table of scenes whose second derivatives, replays and transposed passes other tests hold.
TEST(MassRatio, RowsOfUnlikeBodiesTakeLongNumbers) {
  int rows = 0;
  for (const DotProductScene& row : dotProductScenes()) {
    if (std::string(row.name).rfind("unlike", 0) != 0) continue;
    ++rows;
    EXPECT_TRUE(motionOf(row).events.at(0).wide) << row.name;
  }
  EXPECT_EQ(rows, 3);
}

// Tangent against adjoint through such impacts, with grip and without.
TEST(MassRatio, TangentAndAdjointAreTransposed) {
  for (double friction : {0.0, 0.2, 5.0})
    for (double heavy : {1e4, 1e9}) {
      SCOPED_TRACE("friction " + std::to_string(friction) + ", " + std::to_string(heavy) + " kg");
      Scene s = makeScene({0, 0, -10}, 0.5, friction,
                          {ofMass(makeBox("low", {1, 1, 1}, {0, 0, 1.5}, {0.3, 0.1, 0}), 1e-3),
                           ofMass(makeBall("high", 0.4, {0.1, 0.05, 2.4}, {0.3, 0.1, 0}), heavy),
                           makePlane("floor", Vec3::UnitZ(), 0)});
      OdeContacts contacts(s);
      SimulateOptions options;
      options.impact_limit = 1, options.groups = false;  // the impact alone
      const Motion m = simulate(s, contacts, 0.6, options);
      ASSERT_EQ(m.events.size(), 1u) << m.message;
      EXPECT_GE(m.events[0].contacts.size(), 5u);
      for (std::uint64_t seed = 1; seed <= 3; ++seed) expectTransposed(m, seed);
    }
}

}  // namespace
}  // namespace carom
