// SPDX-License-Identifier: MIT
// Where methods fail (docs/charts.md), what this program does is stated: the right answer, or that it has none.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

Body floorPlane() { return makePlane("floor", Vec3::UnitZ(), 0); }

// A ball of radius 0.05 flies past a fixed one and touches it at `angle` to the tangent.
Scene passing(double angle, double elasticity) {
  return makeScene(Vec3::Zero(), elasticity, 0,
                   {fixedBody(makeBall("fixed", 0.05, Vec3::Zero())),
                    makeBall("ball", 0.05, {-0.4987, 0.1 * std::cos(angle), 0}, {5, 0, 0})});
}

TEST(Grazing, MotionIsRightAtEveryAngleAndElasticity) {
  for (const double angle : {1.5, 0.3, 1e-2, 1e-4, 1e-6, 1e-7})
    for (const double e : {0.0, 0.5, 1.0}) {
      SCOPED_TRACE("angle " + std::to_string(angle) + ", e " + std::to_string(e));
      const Scene scene = passing(angle, e);
      const Motion m = play(scene, 0.2);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      ASSERT_EQ(m.events.size(), 1u);
      const long double y = scene.bodies[1].position.y(), s = std::sqrt((0.1L - y) * (0.1L + y)) / 0.1L;
      const Vec3 n(static_cast<double>(-s), static_cast<double>(y / 0.1L), 0);
      // coordinates of half a metre are known to 5.5e-17 m, so the sine s of the angle to 5.5e-16/s
      const double sine = static_cast<double>(s);
      expectEntries(m.stateAt("ball", 0.2).velocity, Vec3(5, 0, 0) + (1 + e) * 5 * sine * n,
                    1e-14 + 5 * (1 + e) * 5.5e-16 / sine, "velocity");
    }
}

TEST(Grazing, GradientIsMarkedBelowItsMargin) {
  for (const double angle : {1e-2, 1e-5, 2e-7}) {
    SCOPED_TRACE(angle);
    const Motion m = play(passing(angle, 0.7), 0.2);
    StateSeed seed = seedOf(1, Instant::at(0.2), 1);
    Reliability reliability;
    const SceneGradient g = adjoint(m, std::span(&seed, 1), &reliability);
    EXPECT_EQ(reliability.reliable, angle > kReliableMargin) << reliability.message;
    EXPECT_TRUE(flatten(g).allFinite());
  }
}

TEST(Grazing, NothingIsInventedBesideIt) {
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    Scene scene = passing(0, 0.5);
    scene.bodies[1].position.y() = 0.1 + gap;
    EXPECT_TRUE(play(scene, 0.2).events.empty()) << gap;
  }
}

// A heavy ball drives a light one against a wall. With masses 1 and 100^k the impacts are the first digits of pi
// (G. Galperin, Regular and Chaotic Dynamics 8, 2003).
TEST(MassRatio, ImpactsAreTheDigitsOfPi) {
  const std::size_t digits[] = {3, 31, 314, 3141, 31415};
  for (int k = 0; k < 5; ++k) {
    SCOPED_TRACE("mass ratio 100^" + std::to_string(k));
    Scene scene = makeScene(Vec3::Zero(), 1, 0,
                            {makePlane("wall", Vec3::UnitX(), 0), makeBall("light", 0.1, {0.6, 0, 0}),
                             makeBall("heavy", 0.1, {1.35, 0, 0}, {-1, 0, 0})});
    const double ratio = std::pow(100, k);
    scene.bodies[2].mass = ratio;
    const Motion m = play(scene, 1000, 100000);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    EXPECT_EQ(m.impacts, digits[k]);
    const double v = m.stateAt("light", 1000).velocity.x(), w = m.stateAt("heavy", 1000).velocity.x();
    expectEntries(v * v / ratio + w * w, 1.0, 2e-16 * static_cast<double>(10 + m.impacts),
                  "energy");  // a rounding each
    EXPECT_GE(w, v);
  }
}

// A plate as thin as 0.1 mm thrown at one as thin, with any spin: it does not pass, and gains nothing.
TEST(Thin, SpinningPlatesDoNotPass) {
  for (const double thickness : {1e-1, 1e-2, 1e-3, 1e-4})
    for (const double spin : {1.0, 30.0, 1000.0}) {
      SCOPED_TRACE("thickness " + std::to_string(thickness) + ", spin " + std::to_string(spin));
      Body plate = makeBox("plate", {0.2, 0.15, thickness}, {0.01, 0.02, 0.3}, {0.3, 0.1, -20});
      plate.orientation = Quat(1, 0.02, -0.03, 0.01).normalized();
      plate.angular_velocity = spin * Vec3(1, 0.4, 0.3).normalized();
      const Scene scene =
          makeScene(Vec3::Zero(), 0.5, 0, {fixedBody(makeBox("target", {0.4, 0.4, thickness}, Vec3::Zero())), plate});
      const Motion m = play(scene, 0.05);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      EXPECT_FALSE(m.events.empty());
      EXPECT_GT(m.stateAt("plate", m.end).position.z(), 0);
      const WorldLine& line = m.world_lines[1];
      const BodyModel& model = (*m.models)[1];
      double before = kineticEnergy(model, line.arcs.front().startState());
      for (const Arc& arc : line.arcs) {
        const double after = kineticEnergy(model, arc.startState());
        EXPECT_LE(after, before * (1 + 1e-12));
        before = after;
      }
    }
}

// One ball strikes two, the second one later by `gap` seconds.
Scene nearlyTogether(double gap) {
  const double x = 0.1 * std::cos(0.7), y = 0.1 * std::sin(0.7);
  return makeScene(Vec3::Zero(), 0.9, 0,
                   {makeBall("cue", 0.05, {-0.3013, 0, 0}, {3, 0, 0}), makeBall("first", 0.05, {x, y, 0}),
                    makeBall("second", 0.05, {x + 3 * gap, -y, 0})});
}

TEST(Coincidence, OneAfterTheOtherDownToTheInstantThenJointly) {
  Vec3 limit = Vec3::Zero();
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 1e-14}) {
    SCOPED_TRACE(gap);
    const Motion m = play(nearlyTogether(gap), 0.2);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_FALSE(m.events.empty());
    const bool joint = gap < 1e-10;
    EXPECT_EQ(m.events[0].mode == ImpactMode::joint, joint);
    EXPECT_EQ(m.events[0].contacts.size(), joint ? 2u : 1u);
    Vec3 momentum = Vec3::Zero();
    for (int b = 0; b < 3; ++b) momentum += m.stateAt(b, 0.2).velocity;
    expectEntries(momentum, Vec3(3, 0, 0), 1e-14, "momentum");
    const Vec3 v = m.stateAt("first", 0.2).velocity;
    if (gap == 1e-6) limit = v;
    if (gap == 1e-9) expectEntries(v, limit, 1e-4, "the limit of one after the other");
  }
}

// The ball slides where slope * 2/7 > mu (1 + e), and sticks else.
TEST(StickSlip, BothSidesOfTheBoundary) {
  constexpr double kElasticity = 0.5, kDown = 3, kSlope = 1.3;
  const double boundary = 2.0 / 7 * kSlope / (1 + kElasticity);
  for (const double off : {-1e-2, -1e-4, -1e-9, 1e-9, 1e-4, 1e-2}) {
    SCOPED_TRACE(off);
    const double friction = boundary * (1 + off);
    const Scene scene = makeScene(Vec3::Zero(), kElasticity, friction,
                                  {floorPlane(), makeBall("ball", 0.1, {0, 0, 0.22}, {kSlope * kDown, 0, -kDown})});
    const Motion m = play(scene, 0.1);
    ASSERT_EQ(m.events.size(), 1u);
    EXPECT_EQ(m.events[0].mode, off > 0 ? ImpactMode::stick : ImpactMode::slide);
    const double along = std::min(2.0 / 7 * kSlope, friction * (1 + kElasticity)) * kDown;
    expectEntries(m.stateAt("ball", 0.1).velocity, Vec3(kSlope * kDown - along, 0, kElasticity * kDown), 1e-14, "v");
    StateSeed seed = seedOf(1, Instant::at(0.1), 6);
    Reliability reliability;
    adjoint(m, std::span(&seed, 1), &reliability);
    EXPECT_EQ(reliability.reliable, std::abs(off) > 1e-5) << reliability.message;
  }
}

// From 1 m, with 1 - e as small as 1e-6 and e as small as 1e-3.
TEST(Cascade, SettlesWhereItMust) {
  const double t1 = std::sqrt(2 / 9.81);
  for (const double e : {1e-3, 1e-2, 0.5, 0.9}) {
    SCOPED_TRACE(e);
    const Motion m = play(makeScene({0, 0, -9.81}, e, 0, {makeBall("ball", 0.1, {0, 0, 1.1}), floorPlane()}), 60);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_TRUE(m.events.back().settles_at.has_value());
    expectEntries(*m.events.back().settles_at, t1 * (1 + e) / (1 - e), 1e-11, "end of the cascade");
    EXPECT_EQ(m.stateAt("ball", 60).position.z(), 0.1);
  }
}

TEST(Cascade, NearlyElasticBouncesKeepTheirHeight) {
  const double t1 = std::sqrt(2 / 9.81);
  for (const double loss : {1e-2, 1e-4, 1e-6, 0.0}) {
    SCOPED_TRACE(loss);
    const double e = 1 - loss;
    const Motion m = play(makeScene({0, 0, -9.81}, e, 0, {makeBall("ball", 0.1, {0, 0, 1.1}), floorPlane()}), 60, 30);
    EXPECT_EQ(m.status, MotionStatus::impact_limit);
    double t = t1;
    for (std::size_t n = 0; n < 30; ++n) {
      expectEntries(m.events.at(n).time, t, 1e-12, "bounce", 1);
      t += 2 * t1 * std::pow(e, static_cast<double>(n + 1));
    }
  }
}

}  // namespace
}  // namespace carom
