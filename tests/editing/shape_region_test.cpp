// SPDX-License-Identifier: MIT
// Regions kept by the shape itself: clearances against closed forms, against the rule of a ball, against dense sampling
// and against directions tried by the thousand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/motion/guard.hpp"
#include "adjoint/scene/farthest_from.h"
#include "adjoint/simulate/simulate.h"
#include "editing/problem/rows/closest_approach.hpp"
#include "editing/problem/rows/shape_clearance.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/shape_regions.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace editing_detail;
using namespace shape_regions;

namespace {

using namespace test;

Pose poseIn(const Motion& motion, double t) {
  return shapePose(motion, 0, readPlace(motion, 0, Instant::at(t)).state);
}

/// In a pose, by the table of shapes alone: how far the shape stays inside, as far as sampled directions tell.
double insideIn(const Motion& motion, const BoundRegion& bound, int component, double t) {
  const Shape& shape = motion.scene->bodies[0].shape;
  const Mat3 R = motion.stateAt(0, t).orientation.toRotationMatrix();
  const Vec3 x = motion.stateAt(0, t).position - bound.region.position;
  if (const auto* sphere = std::get_if<Sphere>(&bound.region.shape))
    return sphere->radius - bound.margin - farthestFrom(shape, -(R.transpose() * x)).distance;
  const Vec3 n = (component % 2 == 0 ? 1 : -1) * (bound.region.orientation * Vec3::Unit(component / 2));
  const Vec3 local = R.transpose() * n;
  return 0.5 * std::get<Box>(bound.region.shape).size[component / 2] - bound.margin - n.dot(x) -
         kindOf(shape).farthest(shape, local).reach(local);
}

TEST(ShapeRegion, TheFarthestPointFromAPointIsThatOfManyDirections) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const Shape shape = anyShape(random, seed);
    const Vec3 q = anyVector(random, 0.4);
    const FarthestFrom far = farthestFrom(shape, q);
    const Vec3 at = far.farthest.point(far.direction);
    EXPECT_NEAR((at - q).norm(), far.distance, 1e-14) << seed;
    EXPECT_NEAR(far.farthest.reach(far.direction) - far.direction.dot(q), far.distance, 1e-14) << seed;
    for (int k = 0; k < 400; ++k) {
      const Vec3 n = anyVector(random, 1).normalized();
      EXPECT_LE((kindOf(shape).farthest(shape, n).point(n) - q).norm(), far.distance + 1e-14) << seed;
    }
  }
}

// Of a ball the shape is the ball, wherever the nearest place of a box is a face.
TEST(ShapeRegion, ABallIsKeptAsItsBallIs) {
  Scene scene;
  scene.bodies = {shaped("ball", Sphere{0.1}, {-1, 0.03, 0.2}, {2, 0.1, 3}, {3, 1, 2})};
  const Motion motion = fly(scene, 1);
  int compared = 0;
  for (const Region::Side side : {Region::Side::avoid, Region::Side::inside})
    for (const bool sphere : {true, false})
      for (double x = -1; x < 1.3; x += 0.17) {
        BoundRegion bound{{}, 0.05, 0.9, 0.1};
        bound.region.side = side;
        bound.region.position = {x, 0.01, 0.5};
        bound.region.shape = Box{{0.5, 0.6, 0.7}};
        if (sphere) bound.region.shape = Sphere{0.3};
        bound.region.orientation = Quat(0.9, 0.1, -0.3, 0.4).normalized();
        for (int c = 0; c < rowsOf(bound.region); ++c) {
          const auto ball = leastClearance(motion, 0, bound, c);
          BoundRegion of_shape = bound;
          of_shape.margin = 0;
          const auto shape = shapeClearance(motion, 0, of_shape, c);
          ASSERT_TRUE(ball && shape);
          if (side == Region::Side::avoid && !sphere && ball->value > -0.1 + 1e-9) {  // its middle is outside
            EXPECT_GE(shape->reading.value, ball->value - 1e-12);
            continue;
          }
          ++compared;
          EXPECT_NEAR(shape->reading.value, ball->value, 1e-12) << x << " " << c;
          ASSERT_EQ(shape->reading.seeds.size(), 1u);
          const SceneGradient g = adjoint(motion, shape->reading.seeds), h = adjoint(motion, {&ball->seed, 1});
          expectEntries(g.bodies[0].velocity, h.bodies[0].velocity, 1e-7, "by the velocity");
          EXPECT_NEAR(shape->time, ball->time, 1e-6);
          EXPECT_EQ(shape->keeps, ball->keeps);
        }
      }
  EXPECT_GT(compared, 100);
}

TEST(ShapeRegion, ABoxThatTurnsAboveTheBottomOfABox) {
  Scene scene;
  scene.gravity.setZero();
  scene.bodies = {shaped("box", Box{{0.4, 0.1, 0.2}}, {0, 0, 1}, Vec3::Zero(), {0, 2, 0})};
  scene.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
  const Motion motion = fly(scene, 1.5);
  BoundRegion bound{{}, 0, 1.5, 0.03};
  bound.region.side = Region::Side::inside;
  bound.region.shape = Box{{3, 3, 3}};
  bound.region.position = {0, 0, 1.4};
  const auto found = clearanceInside(motion, 0, bound, 5);
  ASSERT_TRUE(found);
  const double diagonal = std::hypot(0.2, 0.1);
  EXPECT_NEAR(found->reading.value, 1 - 1.4 + 1.5 - diagonal - 0.03, 1e-15);
  EXPECT_NEAR(found->time, (std::atan(2.0) - 0.1) / 2, 1e-13);
  EXPECT_FALSE(found->reading.doubt.empty()) << "two corners are as low";
  expectEntries(found->reading.seeds[0].size, Vec3(-0.1 / diagonal, 0, -0.05 / diagonal), 1e-13, "by the size");
  const auto top = clearanceInside(motion, 0, bound, 0);
  ASSERT_TRUE(top);
  EXPECT_EQ(top->keeps, Clearance::Keeps::least);
  EXPECT_NEAR(top->reading.value, 1.5 - diagonal - 0.03, 1e-15);
}

// A rod that points at the middle of a sphere, a block that lies over its edge, and both too deep.
TEST(ShapeRegion, DepthsInClosedForm) {
  const auto depth = [](const Shape& shape, const Vec3& at, const Vec3& turned, const std::variant<Sphere, Box>& region) {
    Scene scene;
    scene.gravity.setZero();
    scene.bodies = {shaped("body", shape, at, Vec3::Zero(), Vec3::Zero())};
    if (!turned.isZero()) scene.bodies[0].orientation = Quat(Eigen::AngleAxisd(turned.norm(), turned.normalized()));
    BoundRegion bound{{}, 0, 1, 0};
    bound.region.shape = region;
    return clearanceOutside(fly(scene, 1), 0, bound)->reading;
  };
  const Vec3 none = Vec3::Zero();
  EXPECT_NEAR(depth(Capsule{0.1, 0.6}, {0, 0, 0.5}, none, Sphere{0.3}).value, 0.5 - 0.3 - 0.1 - 0.3, 1e-15);
  EXPECT_NEAR(depth(Cylinder{0.1, 0.6}, {0, 0.02, 0.25}, none, Sphere{0.3}).value, -0.05 - 0.3 + 0.1 - 0.1, 1e-15);
  EXPECT_NEAR(depth(Cylinder{0.1, 0.6}, {0, 0.09, 0.05}, none, Sphere{0.3}).value, -0.01 - 0.3, 1e-15);
  EXPECT_NEAR(depth(Box{{1, 1, 1}}, {0.8, 0.1, 0.1}, none, Box{{0.8, 2, 2}}).value, 0.8 - 0.5 - 0.4, 1e-15);
  EXPECT_NEAR(depth(Sphere{0.1}, {0.3, 0, 0.1}, none, Box{{0.8, 2, 2}}).value, 0.3 - 0.4 - 0.1, 1e-15);
  // an edge of a block that is turned, above an edge of the region
  const double quarter = std::numbers::pi / 4;
  EXPECT_NEAR(depth(Box{{1, 1, 1}}, {0, 0, 1.15}, {quarter, 0, 0}, Box{{4, 4, 1}}).value,
              1.15 - 0.5 - std::sqrt(0.5), 1e-15);
  // balls and capsules about one centre part in any direction: a number, and no derivative
  const RowReading same = depth(Sphere{0.1}, none, none, Sphere{0.3});
  EXPECT_NEAR(same.value, -0.4, 1e-15);
  EXPECT_TRUE(same.seeds.empty());
  EXPECT_FALSE(same.doubt.empty());
}

// Whatever direction is tried, it separates no more; and near the best one it separates as much.
TEST(ShapeRegion, NoDirectionSeparatesMore) {
  int deep = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const Scene scene = anyFlight(seed);
    if (std::holds_alternative<Compound>(scene.bodies[0].shape)) continue;
    const BoundRegion bound = anyRegion(seed, Region::Side::avoid);
    const Motion motion = fly(scene, 0.1);
    const Body region = regionBody(bound.region);
    const auto geometry = distancesOf(motion).ofTwo(scene.bodies[0], region);
    const auto& distances = dynamic_cast<const BodyDistance&>(*geometry);
    const Pose pose = poseIn(motion, 0.1), still{region.position, region.orientation.toRotationMatrix()};
    Pose at = pose;
    Random random(seed);
    at.x = region.position + anyVector(random, 0.35);
    const Nearest found = distances.separation(0, 1, at, still);
    ASSERT_TRUE(found.apart()) << seed;
    const Vec3 origin = at.x - at.R * centerOfMass(scene.bodies[0]) - region.position;
    const auto separates = [&](const Vec3& n) {
      const auto reach = [&](const Body& body, const Mat3& R, const Vec3& along) {
        const Vec3 local = R.transpose() * along;
        return kindOf(body.shape).farthest(body.shape, local).reach(local);
      };
      return n.dot(origin) - reach(scene.bodies[0], at.R, -n) - reach(region, still.R, n);
    };
    EXPECT_NEAR(separates(found.normal), found.gap, 1e-13) << seed;
    double best = -1e9;
    for (int k = 0; k < 3000; ++k) {
      Vec3 n = anyVector(random, 1).normalized();
      if (k % 2 == 1) n = (found.normal + 0.05 * n).normalized();
      best = std::max(best, separates(n));
    }
    EXPECT_LE(best, found.gap + 1e-13) << seed << ": shape " << scene.bodies[0].shape.index();
    (found.gap < 0 ? deep : apart) += 1;
  }
  EXPECT_GT(deep, 100);
  EXPECT_GT(apart, 20);
}

TEST(ShapeRegion, NothingIsMissedBetweenSamples) {
  int within = 0, crossing = 0, deep = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Motion motion = fly(anyFlight(seed), 1);
    const BoundRegion inside = anyRegion(seed, Region::Side::inside), avoid = anyRegion(seed, Region::Side::avoid);
    for (int c = 0; c < rowsOf(inside.region); ++c) {
      const auto found = clearanceInside(motion, 0, inside, c);
      ASSERT_TRUE(found);
      EXPECT_NEAR(insideIn(motion, inside, c, found->time), found->reading.value, 1e-13) << seed;
      for (int k = 0; k <= 500; ++k) {
        const double t = inside.from + (inside.to - inside.from) * k / 500;
        EXPECT_FALSE(insideIn(motion, inside, c, t) < found->reading.value - 1e-13) << seed << " at " << t;
      }
      EXPECT_LE(found->below, 1e-8) << seed;
      within += found->keeps == Clearance::Keeps::least;
    }
    const auto found = clearanceOutside(motion, 0, avoid);
    ASSERT_TRUE(found);
    const Body region = regionBody(avoid.region);
    const auto geometry = distancesOf(motion).ofTwo(motion.scene->bodies[0], region);
    const auto& distances = dynamic_cast<const BodyDistance&>(*geometry);
    const Pose still{region.position, region.orientation.toRotationMatrix()};
    for (int k = 0; k <= 500; ++k) {
      const double t = avoid.from + (avoid.to - avoid.from) * k / 500;
      const Nearest here = distances.separation(0, 1, poseIn(motion, t), still);
      EXPECT_FALSE(here.gap - avoid.margin < found->reading.value - 1e-12) << seed << " at " << t << ": " << here.gap;
    }
    EXPECT_LE(found->below, 1e-8) << seed;
    (found->reading.value < 0 ? deep : apart) += 1;
    crossing += found->keeps == Clearance::Keeps::two_faces;
  }
  EXPECT_GT(within, 400);
  EXPECT_GT(crossing, 20);
  EXPECT_GT(deep, 50);
  EXPECT_GT(apart, 50);
}

TEST(ShapeRegion, AClosedMeshCountsAsItsHull) {
  // a tetrahedron as mesh and as hull
  const std::vector<Vec3> corners{{0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0}, {0, 0, 0.5}};
  const auto surface = meshSurface(corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  for (const double x : {-0.5, -0.1, 0.05}) {
    double value[2];
    for (const bool hull : {false, true}) {
      const Shape shape = hull ? Shape(Hull{surface, 1, ""}) : Shape(Mesh{surface, 1, ""});
      Scene scene;
      scene.bodies = {shaped("body", shape, {x, 0, 0}, {0, 0.3, 1}, {1, 2, 3})};
      const BoundRegion bound{{}, 0, 0.5, 0};
      value[hull] = clearanceOutside(fly(scene, 0.5), 0, bound)->reading.value;
    }
    EXPECT_NEAR(value[0], value[1], 1e-13);
  }
}

}  // namespace
}  // namespace carom
