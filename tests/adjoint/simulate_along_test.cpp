// SPDX-License-Identifier: MIT
// Motions along a given impact sequence: the same bits at the scene they were taken from, what `simulate` gives beside
// it, derivatives beyond the edges of features, and a status for each way in which a sequence cannot be followed.

#include "adjoint/simulate/simulate_along.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/guard_root.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/dot_product_scenes.h"
#include "tests/support/throws.h"
#include "tests/support/transposed.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;

MotionAlong along(const Motion& like, const Scene& scene, double duration) {
  return simulateAlong(like, scene, OdeContacts(scene).geometry(), duration);
}

/// Every number of every arc and impact, to the last bit.
void expectSameArcsAndEvents(const Motion& found, const Motion& expected) {
  EXPECT_EQ(found.signature(), expected.signature());
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(found.end, expected.end);
  ASSERT_EQ(found.events.size(), expected.events.size());
  EXPECT_EQ(found.impacts, expected.impacts);
  for (std::size_t e = 0; e < found.events.size(); ++e) {
    const Event &f = found.events[e], &x = expected.events[e];
    EXPECT_EQ(f.time, x.time) << "event " << e << ": gap " << x.contacts[0].at.gap << ", approach "
                              << x.contacts[0].approach;
    EXPECT_EQ(f.margins.smallest(), x.margins.smallest());
    ASSERT_EQ(f.contacts.size(), x.contacts.size());
    for (std::size_t k = 0; k < f.contacts.size(); ++k) {
      EXPECT_EQ(f.contacts[k].impulse, x.contacts[k].impulse) << "event " << e;
      EXPECT_EQ(f.contacts[k].at.point, x.contacts[k].at.point) << "event " << e;
    }
  }
  for (std::size_t b = 0; b < found.world_lines.size(); ++b) {
    const WorldLine &f = found.world_lines[b], &x = expected.world_lines[b];
    EXPECT_EQ(f.events, x.events);
    ASSERT_EQ(f.arcs.size(), x.arcs.size());
    for (std::size_t k = 0; k < f.arcs.size(); ++k) {
      const State &s = f.arcs[k].startState(), &t = x.arcs[k].startState();
      EXPECT_TRUE(s.x == t.x && s.q.coeffs() == t.q.coeffs() && s.v == t.v && s.L == t.L) << "arc " << k;
      EXPECT_EQ(f.arcs[k].start(), x.arcs[k].start());
    }
    const Eigen::Matrix<double, 13, 1> end = flatten(found.stateAt(static_cast<int>(b), found.end));
    EXPECT_EQ(end, flatten(expected.stateAt(static_cast<int>(b), found.end)));
  }
}

TEST(MotionAlong, SameSceneGivesTheSameBits) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomScene options;
    options.friction = seed % 2 == 0;
    const Scene scene = randomScene(seed, options);
    const Motion like = play(scene, 1.5, 40);
    const MotionAlong same = along(like, scene, 1.5);
    ASSERT_TRUE(same.complete) << same.why_not;
    EXPECT_FALSE(same.order_changed || same.mode_changed);
    EXPECT_EQ(same.left_out, 0u);
    expectSameArcsAndEvents(same.motion, like);
  }
}

TEST(MotionAlong, SameSceneGivesTheSameBitsForAllShapesAndLaws) {
  for (const DotProductScene& row : dotProductScenes()) {
    SCOPED_TRACE(row.name);
    const Scene scene = row.scene();
    const Motion like = motionOf(row);
    const MotionAlong same = along(like, scene, row.duration);
    ASSERT_TRUE(same.complete) << same.why_not;
    expectSameArcsAndEvents(same.motion, like);
  }
  for (const ShapePair& pair : pairsThatMeet())
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(pair.name() + ", seed " + std::to_string(seed));
      const Throw t = randomThrow(*pair.a, *pair.b, seed);
      const Motion like = play(t.scene, t.duration, 8);
      const MotionAlong same = along(like, t.scene, t.duration);
      ASSERT_TRUE(same.complete) << same.why_not;
      expectSameArcsAndEvents(same.motion, like);
    }
}

/// The scene moved along a direction that keeps it a scene: places and velocities of what moves, and coefficients.
Scene nudged(Scene scene, Random& random, double size) {
  for (Body& body : scene.bodies) {
    if (body.fixed) continue;
    body.position += random.vec(size);
    body.velocity += random.vec(size);
    body.angular_velocity += random.vec(size);
    *body.mass *= 1 + random.in(0, size);
  }
  for (Material& m : scene.materials) m.elasticity *= 1 - random.in(0, size);
  return scene;
}

TEST(MotionAlong, BesideItIsWhatSimulateGives) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = randomScene(seed);
    const Scene other = nudged(scene, random, 1e-3);
    const Motion like = play(scene, 1, 3), expected = play(other, 1, 3);
    const bool ends_in_contact = like.status == MotionStatus::unresolved_contact;
    if (like.signature() != expected.signature() || ends_in_contact) continue;
    const MotionAlong r = along(like, other, 1);
    ASSERT_TRUE(r.complete) << r.why_not;
    EXPECT_EQ(r.motion.signature(), expected.signature());
    ++compared;
    for (std::size_t e = 0; e < expected.events.size(); ++e)
      expectEntries(r.motion.events[e].time, expected.events[e].time, 1e-13, "time of event " + std::to_string(e));
    const double end = std::min(r.motion.end, expected.end);
    for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b)
      expectEntries(flatten(r.motion.stateAt(b, end)), flatten(expected.stateAt(b, end)), 1e-13, "body", 10);
  }
  EXPECT_GE(compared, 60);
}

/// A ball falls onto a fixed box 1 m wide, top at 0, over a floor at -1.
Scene ballOverTable(double x) {
  Body table = fixedBody(makeBox("table", Vec3(1, 1, 0.5), Vec3(0, 0, -0.25)));
  return makeScene(Vec3(0, 0, -9.81), 0.8, 0.4,
                   {makePlane("floor", Vec3::UnitZ(), -1), table, makeBall("ball", 0.1, Vec3(x, 0.1, 1), {0.5, 0, 0})});
}

TEST(MotionAlong, FeaturesGoOnPastTheirEdges) {
  const Motion like = play(ballOverTable(0), 1, 1);
  const Scene beyond = ballOverTable(3);  // a face that went on would be struck here, just as before
  ASSERT_NE(play(beyond, 1, 1).signature(), like.signature());
  const MotionAlong r = along(like, beyond, 1);
  ASSERT_TRUE(r.complete) << r.why_not;
  EXPECT_EQ(r.motion.signature(), like.signature());
  expectEntries(r.motion.events[0].time, like.events[0].time, 1e-14, "time");
  const BodyState state = r.motion.stateAt("ball", 0.8), was = like.stateAt("ball", 0.8);
  expectEntries(state.position - Vec3(3, 0, 0), was.position, 1e-14, "position");
  expectEntries(state.angular_velocity, was.angular_velocity, 1e-14, "angular velocity");
  expectTransposed(r.motion, 1);
}

TEST(MotionAlong, DerivativesBeyondTheSequenceAreTransposed) {
  int left = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = randomScene(seed), other = nudged(scene, random, 0.05);
    const Motion like = play(scene, 1, 4);
    const MotionAlong r = along(like, other, 1);
    if (!r.complete || r.motion.events.empty()) continue;
    if (play(other, 1, 4).signature() != r.motion.signature()) ++left;
    expectTransposed(r.motion, seed);
  }
  EXPECT_GE(left, 5);
}

TEST(MotionAlong, GradientIsTheLimitOfDifferencesPastAnEdge) {
  const Motion like = play(ballOverTable(0), 1, 1);
  const auto height = [&](double lift) {
    Scene scene = ballOverTable(3);
    scene.bodies[2].position.z() += lift;
    return along(like, scene, 1).motion;
  };
  const double h = 1e-4;
  const double difference =
      (height(h).stateAt(2, 0.8).position.z() - height(-h).stateAt(2, 0.8).position.z()) / (2 * h);
  const SceneGradient g = gradientOf(height(0), 2, 0.8, 2);
  expectEntries(g.bodies[2].position.z(), difference, 1e-7, "dz/dz0");
}

TEST(MotionAlong, OrderOfBodiesDoesNotMatter) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto reversed = [](Scene scene) {
      std::reverse(scene.bodies.begin(), scene.bodies.end());
      return scene;
    };
    Random random(seed);
    const Scene scene = randomScene(seed), other = nudged(scene, random, 0.02);
    const MotionAlong r = along(play(scene, 1, 3), other, 1),
                      s = along(play(reversed(scene), 1, 3), reversed(other), 1);
    ASSERT_EQ(r.complete, s.complete);
    if (!r.complete) continue;
    const double end = std::min(r.motion.end, s.motion.end);
    for (const Body& body : scene.bodies)
      expectEntries(flatten(r.motion.stateAt(body.name, end)), flatten(s.motion.stateAt(body.name, end)), 1e-11,
                    body.name, 10);
  }
}

Scene twoBalls(double aside) {
  return makeScene(
      Vec3::Zero(), 0.9, 0,
      {makeBall("a", 0.1, Vec3(-1, 0, 0), Vec3(2, 0, 0)), makeBall("b", 0.1, Vec3(1, aside, 0), Vec3(-1, 0, 0))});
}

TEST(MotionAlongStatus, BodiesThatPass) {
  const Motion like = play(twoBalls(0.1), 2);
  ASSERT_EQ(like.events.size(), 1u);
  const MotionAlong r = along(like, twoBalls(0.21), 2);
  EXPECT_FALSE(r.complete);
  EXPECT_NE(r.why_not.find("pass without touching"), std::string::npos) << r.why_not;
  EXPECT_NE(r.why_not.find("'a' and 'b'"), std::string::npos) << r.why_not;
  EXPECT_EQ(r.motion.status, MotionStatus::unresolved_impact);
  EXPECT_TRUE(along(like, twoBalls(0.1999), 2).complete);
}

/// A ball strikes the floor at about 0.45 s, then a wall at x = 2.
Scene floorThenWall(double speed) {
  return makeScene(Vec3(0, 0, -9.81), 0.8, 0,
                   {makePlane("floor", Vec3::UnitZ(), 0), makePlane("wall", -Vec3::UnitX(), -2),
                    makeBall("ball", 0.1, Vec3(0, 0, 1.1), Vec3(speed, 0, 0))});
}

TEST(MotionAlongStatus, ImpactsOfABodyOutOfOrder) {
  const Motion like = play(floorThenWall(3), 0.8);
  ASSERT_EQ(like.events.size(), 2u);
  const MotionAlong r = along(like, floorThenWall(6), 0.8);
  EXPECT_FALSE(r.complete);
  EXPECT_NE(r.why_not.find("before the impact that precedes it"), std::string::npos) << r.why_not;
  EXPECT_LE(r.motion.end, 0.5);
}

TEST(MotionAlongStatus, ImpactsAfterTheDurationAreLeftOut) {
  const Motion like = play(floorThenWall(3), 0.8);
  const MotionAlong slower = along(like, floorThenWall(2), 0.8);
  ASSERT_TRUE(slower.complete) << slower.why_not;
  EXPECT_EQ(slower.left_out, 1u);
  EXPECT_EQ(slower.motion.events.size(), 1u);
  EXPECT_EQ(slower.motion.end, 0.8);
  const MotionAlong shorter = along(like, floorThenWall(3), 0.3);
  ASSERT_TRUE(shorter.complete);
  EXPECT_EQ(shorter.left_out, 2u);
}

TEST(MotionAlongStatus, OrderOfDifferentBodies) {
  const auto scene = [](double first, double second) {
    return makeScene(Vec3(0, 0, -9.81), 0.8, 0.3,
                     {makePlane("floor", Vec3::UnitZ(), 0), makeBall("a", 0.1, Vec3(0, 0, first)),
                      makeBall("b", 0.1, Vec3(1, 0, second))});
  };
  const Motion like = play(scene(1, 1.2), 0.6);
  const MotionAlong r = along(like, scene(1.3, 1.1), 0.6);
  ASSERT_TRUE(r.complete) << r.why_not;
  EXPECT_TRUE(r.order_changed);
  expectSameArcsAndEvents(along(r.motion, scene(1.3, 1.1), 0.6).motion, r.motion);
  const Motion expected = play(scene(1.3, 1.1), 0.6);
  EXPECT_EQ(r.motion.signature(), expected.signature());
  expectTransposed(r.motion, 2);
}

TEST(MotionAlongStatus, StickBecomesSlide) {
  const auto scene = [](double friction) {
    return makeScene(Vec3(0, 0, -9.81), 0.8, friction,
                     {makePlane("floor", Vec3::UnitZ(), 0), makeBall("a", 0.1, Vec3(0, 0, 1), Vec3(2, 0, 0))});
  };
  const Motion like = play(scene(0.9), 0.6);
  ASSERT_EQ(like.events[0].mode, ImpactMode::stick);
  const MotionAlong r = along(like, scene(0.05), 0.6);
  ASSERT_TRUE(r.complete);
  EXPECT_TRUE(r.mode_changed);
  EXPECT_EQ(r.motion.signature(), play(scene(0.05), 0.6).signature());
}

TEST(MotionAlongStatus, JointImpacts) {
  const auto scene = [](double speed, double turn) {
    Scene s = makeScene(
        Vec3(0, 0, -9.81), 0.8, 0.3,
        {makePlane("floor", Vec3::UnitZ(), 0), makeBox("box", Vec3(0.3, 0.2, 0.1), Vec3(0, 0, 1), Vec3(0, 0, speed))});
    s.bodies[1].orientation = Quat(Eigen::AngleAxisd(turn, Vec3::UnitX()));
    return s;
  };
  const Motion like = play(scene(0, 0), 0.7);
  ASSERT_EQ(like.events[0].mode, ImpactMode::joint);
  const MotionAlong flat = along(like, scene(1, 0), 0.7);
  ASSERT_TRUE(flat.complete) << flat.why_not;
  const Motion expected = play(scene(1, 0), 0.7);
  expectEntries(flatten(flat.motion.stateAt("box", 0.7)), flatten(expected.stateAt("box", 0.7)), 1e-13, "box");
  expectTransposed(flat.motion, 3);
  const MotionAlong turned = along(like, scene(0, 0.01), 0.7);
  EXPECT_FALSE(turned.complete);
  EXPECT_NE(turned.why_not.find("one instant"), std::string::npos) << turned.why_not;
}

TEST(MotionAlongStatus, MomentsThatLoseTheirSymmetry) {
  Scene scene = floorThenWall(3);
  scene.bodies[2].inertia = Inertia::fromMoments(Vec3(1, 1, 1) * 4e-3);
  scene.bodies[2].angular_velocity = Vec3(1, 2, 3);
  const Motion like = play(scene, 0.8);
  scene.bodies[2].inertia.moments.x() *= 1.1;
  const MotionAlong r = along(like, scene, 0.8);
  expectEntries(flatten(r.motion.stateAt("ball", 0.8)), flatten(play(scene, 0.8).stateAt("ball", 0.8)), 1e-13, "ball");
}

TEST(MotionAlongStatus, WrongInput) {
  const Scene scene = floorThenWall(3);
  const Motion like = play(scene, 0.8);
  Scene fewer = scene;
  fewer.bodies.pop_back();
  EXPECT_THROW(simulateAlong(like, fewer, like.geometry, 0.8), InputError);
  EXPECT_THROW(simulateAlong(like, scene, nullptr, 0.8), InputError);
  EXPECT_THROW(simulateAlong(like, scene, like.geometry, std::nan("")), InputError);
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.record_events = false;
  const Motion paths = simulate(scene, contacts, 0.8, options);
  EXPECT_THROW(simulateAlong(paths, scene, like.geometry, 0.8), InputError);
}

TEST(DescendingRoot, OfAFallFromAnywhere) {
  // 1 - (t - 2)^2: rises at 1, falls at 3
  const auto fall = [](double t) { return GuardValue{1 - (t - 2) * (t - 2), -2 * (t - 2), 1, 1}; };
  for (double guess : {0.0, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 6.0, 9.0}) {
    const GuardRoot root = descendingRoot({0, 10, guess, 1}, fall);
    ASSERT_EQ(root.outcome, guess < 1 ? GuardRoot::Outcome::early : GuardRoot::Outcome::found) << guess;
    if (guess >= 1) expectEntries(root.time, 3, 1e-15, "root");
  }
  EXPECT_EQ(descendingRoot({1, 2.5, 2.2, 1}, fall).outcome, GuardRoot::Outcome::late);
}

TEST(DescendingRoot, OfAnApproach) {
  const auto pass = [](double nearest) {
    return [nearest](double t) { return GuardValue{(t - 2) * (t - 2) + nearest, 2 * (t - 2), 1, 1}; };
  };
  for (double guess : {0.1, 1.0, 1.9, 2.2, 4.0}) {
    const GuardRoot root = descendingRoot({0, 10, guess, 1}, pass(-1e-4));
    if (guess < 2) {
      ASSERT_EQ(root.outcome, GuardRoot::Outcome::found) << guess;
      expectEntries(root.time, 1.99, 1e-15, "root");
    }
    EXPECT_EQ(descendingRoot({0, 10, guess, 1}, pass(1e-4)).outcome, GuardRoot::Outcome::none) << guess;
  }
  const auto nothing = [](double) { return GuardValue{std::nan(""), 1, 1, 1}; };
  EXPECT_EQ(descendingRoot({0, 1, 0.5, 1}, nothing).outcome, GuardRoot::Outcome::undefined);
}

}  // namespace
}  // namespace carom
