// SPDX-License-Identifier: MIT
// Bodies that lie on each other: rest at its exact limits, what happens to them, and derivatives.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/tangent.h"
#include "adjoint/motion/lasting_contact.h"
#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/convex_hull.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/support/scenes.h"
#include "tests/support/transposed.h"

namespace carom::components_at_rest {
namespace {

using namespace test;
using std::numbers::pi;

const Vec3 kDown(0, 0, -9.81);

Body floorBox() { return fixedBody(makeBox("floor", {40, 40, 1}, {0, 0, -0.5})); }

// Boxes on top of each other; where the middle of each is, and how high it is.
std::vector<Body> stackOf(const std::vector<Vec2>& places, double height = 1) {
  std::vector<Body> bodies = {floorBox()};
  for (std::size_t i = 0; i < places.size(); ++i)
    bodies.push_back(makeBox("b" + std::to_string(i), {1, 1, height},
                             {places[i].x(), places[i].y(), height * (0.5 + static_cast<double>(i))}));
  return bodies;
}

// About y, which takes z towards x.
Scene turned(Scene scene, double angle) {
  const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  for (Body& b : scene.bodies) b.position = turn * b.position, b.orientation = turn * b.orientation;
  return scene;
}

void expectRests(const Scene& scene, bool rests, const std::string& what) {
  for (const bool reverse : {false, true}) {
    Scene ordered = scene;
    if (reverse) std::ranges::reverse(ordered.bodies);
    const Motion m = playLasting(ordered, 60);
    EXPECT_EQ(m.status, rests ? MotionStatus::complete : MotionStatus::unresolved_contact) << what << ": " << m.message;
    ASSERT_EQ(m.events.size(), 1u) << what;
    for (std::size_t b = 0; rests && b < ordered.bodies.size(); ++b) {
      if (ordered.bodies[b].fixed) continue;
      const BodyState start = m.stateAt(static_cast<int>(b), 0), end = m.stateAt(static_cast<int>(b), 60);
      EXPECT_EQ(start.position, end.position) << what;
      EXPECT_EQ(start.orientation.coeffs(), end.orientation.coeffs()) << what;
      EXPECT_LE((start.position - ordered.bodies[b].position).norm(), 1e-14) << what;
    }
    if (!rests) {
      EXPECT_NE(m.message.find("stay in contact"), std::string::npos) << m.message;
    }
  }
}

TEST(ComponentsAtRest, TenBoxesStandAlignedInZigzagAndOverhanging) {
  const auto places = [](auto placeOf) {
    std::vector<Vec2> out;
    for (int i = 0; i < 10; ++i) out.push_back(placeOf(i));
    return out;
  };
  expectRests(makeScene(kDown, 0.3, 0.5, stackOf(places([](int) { return Vec2(0, 0); }))), true, "aligned");
  expectRests(makeScene(kDown, 0.3, 0.5, stackOf(places([](int i) { return Vec2(i % 2 ? 0.3 : 0, 0.1); }))), true, "zigzag");
  expectRests(makeScene(kDown, 0.3, 0, stackOf(places([](int i) { return Vec2(0.09 * i, 0); }), 0.2)), true, "overhanging, without friction");
}

// Each box from the top on hangs over by l / 2k: the middle of all above is at its border.
TEST(ComponentsAtRest, AHarmonicStackOfTwentyStandsAtItsLimit) {
  for (const double beyond : {-1e-6, 0.0, 1e-6}) {
    std::vector<Vec2> places(20, Vec2::Zero());
    for (int k = 1; k < 20; ++k) places[static_cast<std::size_t>(19 - k)].x() = places[static_cast<std::size_t>(20 - k)].x() - (1 + beyond) / (2 * k);
    expectRests(makeScene(kDown, 0.3, 0.5, stackOf(places, 0.125)), !(beyond > 0), std::to_string(beyond));
  }
}

TEST(ComponentsAtRest, BoxesOnBoxesOnASlopeRestUpToTheirFriction) {
  for (const double share : {1 - 1e-6, 1.0, 1 + 1e-6})
    for (const int count : {2, 3}) {
      std::vector<Vec2> places;
      for (int i = 0; i < count; ++i) places.push_back({0.02 * i, 0});
      expectRests(turned(makeScene(kDown, 0.3, std::tan(0.3) * share, stackOf(places)), 0.3), !(share < 1), std::to_string(share));
    }
}

// A ball on two: tan 15 degrees between them, and a third of that on the floor.
TEST(ComponentsAtRest, ThreeBallsRestUpToTheirFriction) {
  const double between = std::tan(pi / 12), height = std::sqrt(3.0) / 2;
  for (const double share : {1 - 1e-6, 1.0, 1 + 1e-6})
    for (const bool at_floor : {false, true}) {
      Scene scene = makeScene(kDown, 0, at_floor ? 10 : between * share,
                              {floorBox(), makeBall("left", 0.5, {-0.5, 0, 0.5}), makeBall("right", 0.5, {0.5, 0, 0.5}),
                               makeBall("top", 0.5, {0, 0, 0.5 + height})});
      scene.materials.push_back(makeMaterial("floor", 0, at_floor ? between / 3 * share : 10));
      for (Material& m : scene.materials) m.combine_friction = at_floor ? Combine::minimum : Combine::maximum;
      scene.bodies[0].material = "floor";
      expectRests(scene, !(share < 1), (at_floor ? "floor " : "between ") + std::to_string(share));
    }
}

// Milankovitch: half a circle of 21 falls below a thickness of about 0.1067 of its radius.
TEST(ComponentsAtRest, AnArchOf21Stands) {
  for (const double thickness : {0.105, 0.107, 0.2}) {
    std::vector<Body> bodies = {floorBox()};
    for (int i = 0; i < 21; ++i) {
      std::vector<Vec3> corners;
      Vec3 middle = Vec3::Zero();
      for (const double y : {-0.25, 0.25})
        for (const double r : {1 - thickness / 2, 1 + thickness / 2})
          for (const double angle : {pi * i / 21, pi * (i + 1) / 21}) corners.push_back({r * std::cos(angle), y, r * std::sin(angle)});
      for (const Vec3& corner : corners) middle += corner / 8;
      for (Vec3& corner : corners) corner -= middle;
      Body& stone = bodies.emplace_back(makeBox("stone " + std::to_string(i), {1, 1, 1}, middle));
      stone.shape = Hull{convexHull(corners), 1, ""};
    }
    expectRests(makeScene(kDown, 0, 1, bodies), thickness > 0.106, std::to_string(thickness));
  }
}

TEST(ComponentsAtRest, MassesMayDifferByAMillion) {
  for (const double mass : {1e-6, 1e-3, 1e3, 1e6}) {
    std::vector<Vec2> places;
    for (int i = 0; i < 10; ++i) places.push_back({0.03 * i, 0});
    std::vector<Body> bodies = stackOf(places);
    for (std::size_t i = 2; i < bodies.size(); i += 2) bodies[i].mass = mass;
    expectRests(makeScene(kDown, 0.3, 0.5, bodies), true, std::to_string(mass));
  }
}

Scene dropOn(int boxes, const Body& body) {
  std::vector<Body> bodies = stackOf(std::vector<Vec2>(static_cast<std::size_t>(boxes), Vec2(0.05, 0.02)));
  bodies.push_back(body);
  return makeScene(kDown, 0.4, 0.5, bodies);
}

// What bounces on a stack moves as on a fixed one; the boxes go on as if nothing had been.
TEST(ComponentsAtRest, WhatBouncesOnAStackLeavesItAsItIs) {
  for (const Body& body : {makeBall("body", 0.2, {0.1, 0.1, 4}), makeBox("body", {0.3, 0.3, 0.3}, {0.1, 0.1, 4})}) {
    Scene scene = dropOn(3, body), fixed = scene;
    for (std::size_t i = 1; i < 4; ++i) fixed.bodies[i].fixed = true;
    const Motion m = playLasting(scene, 4), on_fixed = playLasting(fixed, 4);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), on_fixed.events.size() + 1);
    for (std::size_t b = 1; b < 4; ++b) EXPECT_EQ(m.world_lines[b].arcs.size(), 2u);
    for (std::size_t e = 0; e < on_fixed.events.size(); ++e) {
      const Event &with = m.events[e + 1], &without = on_fixed.events[e];
      EXPECT_EQ(with.time, without.time);
      ASSERT_EQ(with.participants.size(), 2u);
      EXPECT_TRUE(with.participants[0].stays);
      EXPECT_EQ(with.participants[0].impact, 0);
      EXPECT_FALSE(with.participants[1].stays);
    }
    EXPECT_EQ(flatten(m.stateAt(4, 4.0)), flatten(on_fixed.stateAt(4, 4.0)));
    const std::vector<LastingContact> lasting = lastingContacts(m);
    ASSERT_EQ(lasting.size(), 4u);
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(lasting[static_cast<std::size_t>(i)].body, i + 1);
      EXPECT_EQ(lasting[static_cast<std::size_t>(i)].with, i);
    }
  }
}

// Every size below a body moves where it comes to rest, and so it does where it bounces; the place of the boxes does not.
TEST(ComponentsAtRest, DerivativesReachThroughWhatHoldsABody) {
  for (const Body& body : {makeBall("body", 0.2, {0.1, 0.1, 4}), makeBox("body", {0.4, 0.4, 0.4}, {0.1, 0.1, 4})}) {
    const Scene scene = dropOn(3, body);
    const Motion m = playLasting(scene, 4);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const SceneGradient rest = gradientOf(m, 4, 4.0, 2);
    const double top = 3, fall = std::sqrt(2 * (4 - top - 0.2) / 9.81), at = 0.6;  // after the first bounce, before the second
    const SceneGradient bounces = gradientOf(m, 4, at, 2);
    ASSERT_LT(fall, at);
    const double late = at - fall, dt = -1 / (9.81 * fall);
    for (std::size_t b = 1; b < 4; ++b) {
      EXPECT_NEAR(rest.bodies[b].size.z(), 1, 1e-12);
      EXPECT_NEAR(rest.bodies[b].position.z(), 0, 1e-12);
      EXPECT_NEAR(bounces.bodies[b].position.z(), 0, 1e-12);
      EXPECT_NEAR(bounces.bodies[b].size.z(), bounces.bodies[1].size.z(), 1e-12);
    }
    EXPECT_NEAR(rest.bodies[0].position.z(), 1, 1e-12);
    EXPECT_NEAR(bounces.bodies[0].position.z(), bounces.bodies[1].size.z(), 1e-12);
    // z = h + v t - g t^2/2 after the bounce at t0 = sqrt(2 (z0 - h)/g), with v = 0.4 g t0
    EXPECT_NEAR(bounces.bodies[1].size.z(), 1 + 0.4 * 9.81 * dt * late - (0.4 * 9.81 * fall - 9.81 * late) * dt, 1e-12);
  }
}

// Without rebound: the last bounces of a cascade have as few digits as speed, on what is fixed, too.
TEST(ComponentsAtRest, BothPassesAreTransposed) {
  std::uint64_t seed = 1;
  for (const Scene& scene :
       {makeScene(kDown, 0.3, 0.5, stackOf({{0, 0}, {0.2, 0.1}, {-0.1, 0.05}})), dropOn(1, makeBox("body", {0.5, 0.4, 0.3}, {0.1, 0, 2})),
        dropOn(2, makeBall("body", 0.2, {0.1, 0.1, 3}, {0, 0, -1})), turned(makeScene(kDown, 0.3, 0.6, stackOf({{0, 0}, {0.1, 0}})), 0.3)})
    for (const bool reverse : {false, true}) {
      Scene ordered = scene;
      ordered.materials[0].elasticity = 0;
      if (reverse) std::ranges::reverse(ordered.bodies);
      const Motion m = playLasting(ordered, 3);
      ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
      const std::string before = m.signature();
      expectTransposed(m, seed++);
      EXPECT_EQ(m.signature(), before);
    }
}

// A replay closes the gaps of the whole component, as derivatives have it.
TEST(ComponentsAtRest, ReplaysKeepWhatHoldsABody) {
  const double h = 1e-3;
  for (const Body& body : {makeBall("body", 0.2, {0.1, 0.1, 4}), makeBox("body", {0.4, 0.4, 0.4}, {0.1, 0.1, 4})}) {
    const Scene scene = dropOn(3, body);
    const Motion m = playLasting(scene, 4);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    Scene higher = scene, thicker = scene;
    higher.bodies[4].position.z() += h;
    std::get<Box>(thicker.bodies[2].shape).size.z() += h;
    const MotionAlong again = simulateAlong(m, higher, m.geometry, 4), anew = simulateAlong(m, thicker, OdeContacts(thicker).geometry(), 4);
    ASSERT_TRUE(again.complete && anew.complete) << again.why_not << anew.why_not;
    const Motion played = playLasting(higher, 4);
    ASSERT_EQ(played.signature(), m.signature());
    expectEntries(flatten(again.motion.stateAt(4, 4.0)), flatten(played.stateAt(4, 4.0)), 1e-12, "higher");
    expectEntries(again.motion.stateAt(4, 1.0).position, played.stateAt(4, 1.0).position, 1e-12, "higher, on the way");
    for (int b = 1; b < 5; ++b)
      EXPECT_NEAR(anew.motion.stateAt(b, 4.0).position.z() - m.stateAt(b, 4.0).position.z(), b < 2 ? 0 : b == 2 ? h / 2 : h, 1e-14);
  }
}

// A hit from the side is more than friction holds: what is struck goes, and as it presses on what lies below, the motion ends.
TEST(ComponentsAtRest, WhatIsStruckFromTheSideIsNamed) {
  Scene scene = makeScene(kDown, 0.4, 0.5, stackOf({{0, 0}, {0, 0}}));
  scene.bodies.push_back(makeBall("ball", 0.2, {-2, 0, 1.5}, {5, 0, 1}));
  const Motion m = playLasting(scene, 2);
  EXPECT_EQ(m.status, MotionStatus::unresolved_contact) << m.message;
  EXPECT_NE(m.message.find("'b0' and 'b1' stay in contact"), std::string::npos) << m.message;
  EXPECT_GT(m.end, 0.1);
}

// A plank over the edge of a table, with a weight on its other end that is knocked off from below: nothing holds the plank then.
TEST(ComponentsAtRest, WhatLosesItsWeightTips) {
  Scene scene = makeScene(kDown, 0.4, 0.5,
                          {fixedBody(makeBox("table", {4, 0.2, 1}, {-2, 0, -0.5})), makeBox("plank", {2, 0.2, 0.1}, {0.2, 0, 0.05}),
                           makeBox("weight", {0.2, 1, 0.1}, {-0.7, 0, 0.15}), makeBall("left", 0.05, {-0.7, -0.4, -0.5}, {0, 0, 5}),
                           makeBall("right", 0.05, {-0.7, 0.4, -0.5}, {0, 0, 5})});
  scene.bodies[2].mass = 1, scene.bodies[3].mass = scene.bodies[4].mass = 1;
  const Motion m = playLasting(scene, 0.3);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  ASSERT_GE(m.events.size(), 2u);
  EXPECT_EQ(m.events[0].kind, EventKind::placed);
  EXPECT_EQ(m.world_lines[1].arcs[1].kind(), ArcKind::rest);
  EXPECT_EQ(m.world_lines[1].arcs.back().kind(), ArcKind::pivot);
  EXPECT_EQ(m.world_lines[1].arcs.back().start(), m.events[1].time);
  EXPECT_GT(m.stateAt(2, 0.3).position.z(), 0.3);
}

// Touching does not press: what stands side by side rests by itself.
TEST(ComponentsAtRest, WhatTouchesWithoutForceIsNotHeld) {
  const Scene scene = makeScene(kDown, 0.3, 0.5, {floorBox(), makeBox("a", {1, 1, 1}, {0, 0, 0.5}), makeBox("b", {1, 1, 1}, {1, 0.1, 0.5})});
  const Motion m = playLasting(scene, 2);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  EXPECT_EQ(m.events.size(), 2u);
  for (const Event& e : m.events)
    for (const Contact& c : e.contacts) EXPECT_EQ(std::min(c.a, c.b), 0);
}

// A ball on a box may roll away: its place of rest does not say where to.
TEST(ComponentsAtRest, WhatNothingOpposesIsMarked) {
  const Motion m = playLasting(dropOn(2, makeBall("body", 0.2, {0.1, 0.1, 3})), 4);
  ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
  DerivativeTape tape(m);
  StateSeed seed;
  seed.body = 3, seed.at = Instant::at(4), seed.position = Vec3::UnitX();
  Reliability reliability;
  adjoint(tape, std::span(&seed, 1), &reliability);
  reliability.askVelocity(3);
  EXPECT_FALSE(reliability.reliable);
}

}  // namespace
}  // namespace carom::components_at_rest
