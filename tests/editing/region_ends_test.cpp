// SPDX-License-Identifier: MIT
// Regions over spans that end anywhere: what is read of them lies within the span, to the last bit, and so within a
// motion that ends where the span does.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "editing/edit.h"
#include "editing/problem/rows/shape_clearance.hpp"
#include "tests/editing/scenes.h"
#include "tests/editing/shape_regions.h"

namespace carom {

using namespace editing_detail;
using namespace shape_regions;

namespace {

using test::Random;

/// It bounces a few times and then rolls, so that arcs are long and begin anywhere.
Scene bouncingBall(Random& random) {
  Scene scene = test::makeScene({0, 0, -9.81}, random.in(0, 0.7), 0.3, {});
  Body floor = test::fixedBody(shaped("floor", Plane{}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero()));
  Body body = shaped("body", Sphere{0.025}, {random.in(-1, 0), 0, random.in(0.3, 1)},
                     {random.in(0.5, 2), random.in(-0.3, 0.3), 0}, Vec3::Zero());
  floor.material = body.material = "m";
  scene.bodies = {std::move(floor), std::move(body)};
  return scene;
}

/// An end of a span: anywhere, an event of the motion, or a double beside one.
double anyEnd(Random& random, const Motion& motion, double low) {
  const double anywhere = random.in(low, motion.end);
  if (random.below(2) == 0) return anywhere;
  for (const Event& event : motion.events)
    if (event.time > low && event.time < motion.end && random.below(2) == 0)
      return random.below(2) == 0 ? event.time : std::nextafter(event.time, motion.end);
  return anywhere;
}

void expectWithin(const Motion& motion, const BoundRegion& bound) {
  for (int component = 0; component < rowsOf(bound.region); ++component) {
    SCOPED_TRACE(rowName(bound.region, component));
    double time = 0;
    std::vector<StateSeed> seeds;
    if (bound.region.keep == Region::Keep::shape) {
      const auto least = shapeClearance(motion, 1, bound, component);
      ASSERT_TRUE(least.has_value());
      time = least->time, seeds = least->reading.seeds;
    } else {
      const auto least = leastClearance(motion, 1, bound, component);
      ASSERT_TRUE(least.has_value());
      time = least->time, seeds = {least->seed};
    }
    EXPECT_TRUE(time >= bound.from && time <= bound.to) << time - bound.from << ", " << bound.to - time;
    for (const StateSeed& seed : seeds) EXPECT_TRUE(adjoint(motion, {&seed, 1}).bodies[1].velocity.allFinite());
  }
}

TEST(RegionEnds, WhatIsReadLiesWithinTheSpan) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Scene scene = bouncingBall(random);
    const Motion whole = fly(scene, random.in(1, 3));
    BoundRegion bound = anyRegion(seed, random.below(2) == 0 ? Region::Side::avoid : Region::Side::inside);
    bound.region.keep = random.below(3) == 0 ? Region::Keep::shape : Region::Keep::ball;
    bound.from = anyEnd(random, whole, 0);
    bound.to = anyEnd(random, whole, bound.from);
    expectWithin(fly(scene, bound.to), bound);
  }
}

TEST(RegionEnds, EditsAreTriedUpToTheEndOfTheSpan) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Scene scene = bouncingBall(random);
    const double duration = random.in(1, 2), end = duration - random.in(0, 0.1);
    Region region;
    region.side = Region::Side::inside;
    region.shape = Box{{0.2, 0.2, 0.4}};
    region.position = fly(scene, duration).stateAt("body", end).position + Vec3(0.05, 0.02, 0.1);
    region.during = {end - 0.05, end};
    Constraint inside{"body", 0.0, {}};
    inside.regions = {region};
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, duration, {velocity("body").only({"x", "y"})}, {inside});
    const EditResult result = edit.solve({.effort = Effort::fast});
    testing_scenes::expectHonest(result, duration, contacts);
  }
}

}  // namespace
}  // namespace carom
