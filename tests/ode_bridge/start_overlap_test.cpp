// SPDX-License-Identifier: MIT
// Bodies that overlap at the start are left alone until they part; filters keep pairs apart for good.

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/ode_bridge/refusing.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

// Two balls that part along z at the speed v: |d + v t| = 2 r.
TEST(StartOverlap, BallsPart) {
  const Scene scene = makeScene(Vec3::Zero(), 1, 0,
                                {makeBall("low", 0.5, Vec3::Zero()), makeBall("high", 0.5, {0, 0, 0.4}, {0, 0, 2})});
  const Motion m = play(scene, 1);
  ASSERT_EQ(m.overlaps.size(), 1u);
  EXPECT_EQ(m.overlaps[0].a, 0);
  EXPECT_EQ(m.overlaps[0].b, 1);
  EXPECT_TRUE(std::abs(m.overlaps[0].depth - 0.6) <= 1e-12) << m.overlaps[0].depth;
  ASSERT_TRUE(m.overlaps[0].parted);
  EXPECT_TRUE(std::abs(*m.overlaps[0].parted - 0.3) <= 1e-10) << *m.overlaps[0].parted;
  EXPECT_TRUE(m.events.empty());
  EXPECT_NE(describeOverlap(scene, m.overlaps[0]).find("'low' and 'high' overlap by 0.6 m at the start and separate at t = 0.3"),
            std::string::npos)
      << describeOverlap(scene, m.overlaps[0]);
}

TEST(StartOverlap, RemainsWhereNothingParts) {
  const Motion m = play(makeScene({0, 0, -9.81}, 1, 0,
                                  {makeBox("a", {1, 1, 1}, Vec3::Zero()), makeBox("b", {1, 1, 1}, {0.2, 0, 0.1})}),
                        2);
  ASSERT_EQ(m.overlaps.size(), 1u);
  EXPECT_FALSE(m.overlaps[0].parted);
  EXPECT_EQ(m.status, MotionStatus::complete);
  EXPECT_NE(describeOverlap(*m.scene, m.overlaps[0]).find("do not separate"), std::string::npos);
}

// A ball is thrown up out of a table, falls back and bounces: from then on they collide.
TEST(StartOverlap, CollidesOnceParted) {
  for (const bool boxes : {false, true})
    for (const bool reversed : {false, true}) {
      const double g = 9.8, v = 5, r = 0.1, depth = 0.15;
      const Vec3 start(0, 0, r - depth);
      Body thrown = boxes ? makeBox("thrown", {0.2, 0.2, 0.2}, start, {0, 0, v}) : makeBall("thrown", r, start, {0, 0, v});
      const Body table = fixedBody(makeBox("table", {2, 2, 1}, {0.3, 0, -0.5}));
      const Scene scene =
          makeScene({0, 0, -g}, 0.5, 0, reversed ? std::vector{table, thrown} : std::vector{thrown, table});
      const Motion m = play(scene, 1.2);
      const double root = std::sqrt(v * v - 2 * g * depth);
      ASSERT_EQ(m.overlaps.size(), 1u);
      ASSERT_TRUE(m.overlaps[0].parted);
      EXPECT_TRUE(std::abs(*m.overlaps[0].parted - (v - root) / g) <= 1e-9) << *m.overlaps[0].parted;
      ASSERT_EQ(m.events.size(), 1u);
      EXPECT_TRUE(std::abs(m.events[0].time - (v + root) / g) <= 1e-12) << m.events[0].time;
      // the parting is no event: the derivative is that of the fall
      const SceneGradient d = gradientOf(m, bodyIndex(scene, "thrown"), 1.1, 2);
      const double tau = (v + root) / g, s = 1.1 - tau, e = 0.5;
      const double tau_z = 1 / root, by_tau = -root - e * root + s * g * (1 + e);
      const double expected = 1 + by_tau * tau_z;
      EXPECT_TRUE(std::abs(d.bodies[static_cast<std::size_t>(bodyIndex(scene, "thrown"))].position.z() - expected) <=
                  1e-9 * std::abs(expected));
    }
}

TEST(StartOverlap, OthersAreStruckMeanwhile) {
  // the ball inside the box takes part in impacts of its own
  const Scene scene = makeScene(Vec3::Zero(), 1, 0,
                                {makeBall("inside", 0.1, Vec3::Zero(), {0.1, 0, 0}), makeBox("box", {1, 1, 1}, Vec3::Zero()),
                                 makeBall("bullet", 0.05, {-1, 0, 0}, {3, 0, 0})});
  const Motion m = play(scene, 4);
  ASSERT_EQ(m.overlaps.size(), 1u);
  ASSERT_FALSE(m.events.empty());
  for (const Event& e : m.events) {
    const bool overlapping = !m.overlaps[0].parted || e.time < *m.overlaps[0].parted;
    EXPECT_FALSE(overlapping && e.touches(0, 1)) << e.time;
  }
}

TEST(StartOverlap, OptionRefuses) {
  const Scene scene =
      makeScene(Vec3::Zero(), 1, 0, {makeBall("a", 0.5, Vec3::Zero()), makeBall("b", 0.5, {0, 0, 0.4})});
  try {
    playRefusing(scene, 1);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "/bodies/1");
    EXPECT_NE(error.message().find("'a' and 'b' overlapping by 0.6 m at the start"), std::string::npos) << error.what();
  }
}

// A source accepts what overlaps in the scene that it was made for, and nothing else: an edit may not push bodies into
// one another.
TEST(StartOverlap, OnlyThatOfTheSceneItWasMadeFor) {
  Scene scene = makeScene(Vec3::Zero(), 1, 0,
                          {makeBall("a", 0.5, Vec3::Zero()), makeBall("b", 0.5, {0, 0, 0.4}), makeBall("c", 0.5, {3, 0, 0})});
  OdeContacts contacts(scene);
  EXPECT_EQ(contacts.overlaps().size(), 1u);
  scene.bodies[1].position.z() = 0.5;
  EXPECT_EQ(simulate(scene, contacts, 1).overlaps.size(), 1u);
  const auto other = contacts.another();
  EXPECT_EQ(simulate(scene, *other, 1).overlaps.size(), 1u);
  scene.bodies[2].position.x() = 0.7;
  EXPECT_THROW(simulate(scene, contacts, 1), InputError);
  EXPECT_THROW(simulate(scene, *other, 1), InputError);
}

Scene crossing(int extra) {
  std::vector<Body> bodies{makeBall("left", 0.2, {-1, 0, 0}, {2, 0, 0}), makeBall("right", 0.2, {1, 0, 0}, {-2, 0, 0})};
  for (int i = 0; i < extra; ++i)
    bodies.push_back(makeBall("far" + std::to_string(i), 0.1, {10.0 + i, 0.5 * i, 0}, {0, 0, 1}));
  return makeScene(Vec3::Zero(), 1, 0, bodies);
}

TEST(CollisionFilter, IsSymmetric) {
  for (const int extra : {0, 60}) {  // few bodies, and so many that they have windows
    Scene scene = crossing(extra);
    EXPECT_EQ(play(scene, 1).events.size(), 1u);
    Body &left = scene.bodies[0], &right = scene.bodies[1];
    const auto meets = [&](const CollisionFilter& a, const CollisionFilter& b) {
      left.collision_filter = a, right.collision_filter = b;
      const bool first = !play(scene, 1).events.empty();
      left.collision_filter = b, right.collision_filter = a;
      EXPECT_EQ(!play(scene, 1).events.empty(), first);
      EXPECT_EQ(mayCollide(left, right), first);
      return first;
    };
    EXPECT_TRUE(meets({{"p"}, {}, {}}, {}));
    EXPECT_FALSE(meets({{"p"}, {}, {}}, {{}, {}, {"p"}}));
    EXPECT_TRUE(meets({{"p"}, {}, {}}, {{}, {}, {"q"}}));
    EXPECT_TRUE(meets({{"p"}, {}, {}}, {{}, {"p", "q"}, {}}));
    EXPECT_FALSE(meets({{"p"}, {"q"}, {}}, {{}, {"p"}, {}}));  // one lets, the other does not
    EXPECT_TRUE(meets({{"p"}, {"q"}, {}}, {{"q"}, {"p"}, {}}));
    EXPECT_FALSE(meets({}, {{}, {"p"}, {}}));
  }
}

TEST(CollisionFilter, ExcludedPairsMayOverlap) {
  Scene scene = makeScene(Vec3::Zero(), 1, 0, {makeBall("a", 0.5, Vec3::Zero()), makeBall("b", 0.5, {0, 0, 0.4})});
  scene.bodies[0].collision_filter = {{"ghosts"}, {}, {"ghosts"}};
  scene.bodies[1].collision_filter = {{"ghosts"}, {}, {}};
  EXPECT_TRUE(playRefusing(scene, 1).overlaps.empty());
}

// Balls under different shares of gravity do not fly straight relative to each other.
TEST(GravityFactor, BallsMeetAgain) {
  for (const int extra : {0, 60}) {
    Scene scene = crossing(extra);
    scene.gravity = {0, 0, -9.8};
    scene.bodies[0] = makeBall("floating", 0.1, {0, 0, 1});
    scene.bodies[1] = makeBall("thrown", 0.1, {0, 0, 1.2}, {0, 0, 3});
    scene.bodies[0].gravity_factor = 0;
    const Motion m = play(scene, 0.7);
    ASSERT_FALSE(m.events.empty());
    EXPECT_TRUE(std::abs(m.events[0].time - 6 / 9.8) <= 1e-12) << m.events[0].time;
  }
}

}  // namespace
}  // namespace carom
