// SPDX-License-Identifier: MIT
// Impacts without any rebound: what they leave flying flies on, as it does with a rebound too small to matter.

#include <gtest/gtest.h>

#include <cmath>

#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;

constexpr int kScenesWithoutBounce = 800;

Shape randomShape(Random& random) {
  const double size = random.in(0.05, 0.2);
  switch (random.below(6)) {
    case 0:
      return Sphere{size};
    case 1:
      return Capsule{0.3 * size, 3 * size};
    case 2:
      return Cylinder{size, random.in(0.1, 0.5)};
    case 3:
      return Cone{1.2 * size, random.in(0.1, 0.4)};
    default: {
      const double height = random.in(0.1, 0.4), depth = random.in(0.1, 0.4);
      return Box{Vec3(size, depth, height)};
    }
  }
}

Scene randomFall(std::uint64_t seed, double elasticity) {
  Random random(seed);
  std::vector<Body> bodies;
  const int count = 1 + random.below(3);
  for (int i = 0; i < count; ++i) {
    Body body = makeBox("b" + std::to_string(i), {1, 1, 1}, {random.in(-0.5, 0.5), 0.8 * i, random.in(0.6, 1.5)});
    body.shape = randomShape(random);
    body.orientation = random.rotation();
    body.velocity = random.vec(1);
    body.angular_velocity = random.vec(random.below(2) == 0 ? 5 : 50);
    bodies.push_back(body);
  }
  bodies.push_back(makePlane("floor", Vec3::UnitZ(), 0));
  return makeScene({0, 0, -9.81}, elasticity, random.below(2) == 0 ? 0 : random.in(0, 1), bodies);
}

Motion playUntilItLasts(const Scene& scene) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = 200;
  options.lowest_bounce = 0;
  return simulate(scene, contacts, 1.5, options);
}

// A rattle between two corners is a cascade while it rebounds a little, which ends the motion; without a rebound both
// corners soon touch at once, and what they leave flying flies on. Nothing else tells the two apart.
TEST(NoBounce, IsTheLimitOfASmallOne) {
  int cascades = 0, events = 0, alike = 0;
  for (std::uint64_t seed = 1; seed <= kScenesWithoutBounce; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Motion none = playUntilItLasts(randomFall(seed, 0)), small = playUntilItLasts(randomFall(seed, 1e-9));
    ASSERT_FALSE(none.events.empty());
    events += static_cast<int>(none.events.size());
    cascades += none.status == MotionStatus::cascade;
    EXPECT_TRUE(none.end >= small.end - 1e-6) << none.message << "\n" << small.message;
    const bool same = none.status == small.status && std::abs(none.end - small.end) <= 1e-6;
    alike += same;
    if (same) continue;
    ASSERT_GE(small.events.size(), 8u);
    const double rattled = small.events.back().time - small.events[small.events.size() - 5].time;
    EXPECT_TRUE(small.status == MotionStatus::cascade && rattled < 1e-6) << none.message << "\n" << small.message;
  }
  std::printf("%d of %d scenes alike, %d cascades, %d impacts\n", alike, kScenesWithoutBounce, cascades, events);
  EXPECT_GE(alike, kScenesWithoutBounce - kScenesWithoutBounce / 50);
}

// A capsule that spins is thrown off the floor by its own turning.
TEST(NoBounce, ASpinningCapsuleLeavesTheFloor) {
  for (double elasticity : {0.0, 1e-9}) {
    SCOPED_TRACE(elasticity);
    Body capsule = makeBox("capsule", {1, 1, 1}, {0, 0, 1});
    capsule.shape = Capsule{0.05, 0.4};
    capsule.angular_velocity = {0, 100, 0};
    const Motion m = play(makeScene({0, 0, -9.81}, elasticity, 0, {capsule, makePlane("floor", Vec3::UnitZ(), 0)}), 1.2);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    ASSERT_EQ(m.events.size(), 1u);
    EXPECT_GT(m.stateAt(0, 1).position.z(), 1);
  }
}

// What lands without a rebound stays; a box on its edge falls on its face.
TEST(NoBounce, WhatLandsStays) {
  const Body floor = makePlane("floor", Vec3::UnitZ(), 0);
  Body tilted = makeBox("box", {0.4, 0.3, 0.2}, {0, 0, 1}, {0.3, 0, 0});
  tilted.orientation = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
  for (double friction : {0.0, 0.4})
    for (const Body& body : {makeBall("ball", 0.1, {0, 0, 1}, {1, 0, 0}),
                             makeBox("box", {0.4, 0.3, 0.2}, {0, 0, 1}, {0.3, 0, 0}), tilted}) {
      const Motion m = play(makeScene({0, 0, -9.81}, 0, friction, {body, floor}), 2);
      SCOPED_TRACE(body.name + ", friction " + std::to_string(friction));
      EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
      ASSERT_FALSE(m.events.empty());
      if (!body.orientation.coeffs().isApprox(tilted.orientation.coeffs(), 0)) {
        EXPECT_EQ(m.events[0].kind, EventKind::capture);
        continue;
      }
      EXPECT_EQ(m.events[0].kind, EventKind::impact);  // it turns so fast then that the edge comes off
      EXPECT_EQ(m.events[0].contacts.size(), 2u) << m.describeEvent(0);
      const BodyState end = m.stateAt(0, 2);
      EXPECT_TRUE(std::abs(end.position.z() - 0.1) <= 1e-12) << end.position.z();
      EXPECT_TRUE(std::abs((end.orientation * Vec3::UnitZ()).z() - 1) <= 1e-12);
      EXPECT_EQ(m.world_lines[0].arcs.back().kind(), friction > 0 ? ArcKind::rest : ArcKind::slide);
    }
}

}  // namespace
}  // namespace carom
