// SPDX-License-Identifier: MIT
// Regions on slides round a bend: the least clearance against sampling that is refined, its derivative against
// differences, and an edit that is kept out of a region.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/problem/rows/region_rows.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom {

using namespace editing_detail;

namespace {

// A crate, or a ball, is pushed across a slope that falls along y, and slides until it rests or rolls.
Scene acrossASlope(bool ball) {
  Scene scene;
  scene.gravity = {0, 1.2, -9.7};
  scene.materials.push_back({.name = "wood", .elasticity = 0.3, .friction = 0.25});
  Body floor, body;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{}, floor.material = "wood";
  body.name = "body", body.material = "wood", body.mass = 2, body.position = {0, 0, 0.1}, body.velocity = {3, -1.4, 0};
  body.shape = ball ? Shape(Sphere{0.1}) : Shape(Box{{0.3, 0.2, 0.2}});
  if (ball) body.angular_velocity = {-20, -12, 3};
  scene.bodies = {floor, body};
  return scene;
}

double clearanceAt(const Motion& motion, const BoundRegion& bound, int component, double t) {
  const Vec3 y = bound.region.orientation.conjugate() * (motion.stateAt(1, t).position - bound.region.position);
  const bool avoid = bound.region.side == Region::Side::avoid;
  if (const auto* sphere = std::get_if<Sphere>(&bound.region.shape))
    return (avoid ? y.norm() - sphere->radius : sphere->radius - y.norm()) - bound.margin;
  const Vec3 half = 0.5 * std::get<Box>(bound.region.shape).size;
  if (avoid) return (y.cwiseAbs() - half).maxCoeff() - bound.margin;
  return half[component / 2] - (component % 2 == 0 ? 1 : -1) * y[component / 2] - bound.margin;
}

// Samples, and those around the least one again and again.
double sampledLeast(const Motion& motion, const BoundRegion& bound, int component) {
  double from = bound.from, to = bound.to, at = from, least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 11; ++round) {
    const int count = round == 0 ? 3000 : 60;
    for (int i = 0; i <= count; ++i) {
      const double t = from + (to - from) * i / count, value = clearanceAt(motion, bound, component, t);
      if (value < least) least = value, at = t;
    }
    const double step = 2 * (to - from) / count;
    from = std::max(bound.from, at - step), to = std::min(bound.to, at + step);
  }
  return least;
}

std::vector<BoundRegion> someRegions() {
  std::vector<BoundRegion> bounds;
  for (const Region::Side side : {Region::Side::avoid, Region::Side::inside})
    for (const bool sphere : {true, false})
      for (double x = 0; x < 2; x += 0.37) {
        Region region;
        region.side = side;
        region.shape = Box{{0.5, 0.4, 0.6}};
        if (sphere) region.shape = Sphere{0.3};
        region.position = {x, -0.35 + 0.1 * x, 0.12};
        if (x > 1) region.orientation = Quat(0.9, 0.1, -0.3, 0.4).normalized();
        bounds.push_back({region, 0.05, 1.3, 0.02});
      }
  return bounds;
}

class CurvedRegion : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Bodies, CurvedRegion, testing::Values(false, true),
                         [](const auto& ball) { return ball.param ? "Ball" : "Crate"; });

TEST_P(CurvedRegion, TheLeastClearanceIsThatOfSamples) {
  const Scene scene = acrossASlope(GetParam());
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1.4);
  ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
  ASSERT_GT(motion.world_lines[1].arcs[1].accelerationVariation(), 0.1);
  for (const BoundRegion& bound : someRegions()) {
    for (int component = 0; component < rowsOf(bound.region); ++component) {
      const auto least = leastClearance(motion, 1, bound, component);
      ASSERT_TRUE(least.has_value());
      const double sampled = sampledLeast(motion, bound, component);
      EXPECT_TRUE(std::abs(least->value - sampled) <= 1e-12)
          << rowName(bound.region, component) << " at x = " << bound.region.position.x() << ": " << least->value
          << ", sampled " << sampled;
      EXPECT_TRUE(std::abs(clearanceAt(motion, bound, component, least->time) - least->value) <= 1e-13);
    }
  }
}

// A box that stands on an edge and falls over: its path is integrated, and no parabola is near it.
TEST(ConstrainedRegion, TheLeastClearanceIsThatOfSamples) {
  for (const double tilt : {0.2, 0.7}) {
    Scene scene;
    scene.gravity = {0, 0, -9.81};
    scene.materials.push_back({.name = "rough", .elasticity = 0, .friction = 2});
    Body floor, body;
    floor.name = "floor", floor.fixed = true, floor.shape = Plane{}, floor.material = "rough";
    body.name = "body", body.material = "rough", body.mass = 2, body.shape = Box{{0.3, 0.4, 0.8}};
    const double c = std::cos(tilt / 2), s = std::sin(tilt / 2);
    body.orientation = Quat(c, 0, s, 0);
    body.position = {0.2, -0.1, 0.4 * std::cos(tilt) + 0.15 * std::sin(tilt)};
    scene.bodies = {floor, body};
    OdeContacts contacts(scene);
    const Motion motion = simulate(scene, contacts, 0.5);
    ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
    const auto& arcs = motion.world_lines[1].arcs;
    ASSERT_TRUE(std::any_of(arcs.begin(), arcs.end(), [](const Arc& arc) { return arc.kind() == ArcKind::pivot; }));
    int which = 0;
    for (BoundRegion bound : someRegions()) {
      if (which++ % 3 != 0) continue;  // the samples take long
      bound.region.position = motion.stateAt(1, 0.1 + 0.15 * bound.region.position.x()).position + Vec3(0.03, 0.02, -0.04);
      bound.to = 0.45;
      for (int component = 0; component < rowsOf(bound.region); ++component) {
        const auto least = leastClearance(motion, 1, bound, component);
        ASSERT_TRUE(least.has_value());
        const double sampled = sampledLeast(motion, bound, component);
        EXPECT_TRUE(std::abs(least->value - sampled) <= 1e-12)
            << "tilt " << tilt << ", " << rowName(bound.region, component) << ": " << least->value << ", sampled " << sampled;
        EXPECT_TRUE(std::abs(clearanceAt(motion, bound, component, least->time) - least->value) <= 1e-13);
      }
    }
  }
}

TEST_P(CurvedRegion, ItsDerivativeIsThatOfDifferences) {
  const Scene scene = acrossASlope(GetParam());
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1.4);
  for (const BoundRegion& bound : someRegions()) {
    const auto least = leastClearance(motion, 1, bound, 0);
    ASSERT_TRUE(least.has_value());
    const Vec3 gradient = adjoint(motion, {&least->seed, 1}).bodies[1].velocity;
    for (int j = 0; j < 2; ++j) {
      const auto valueAt = [&](double step) {
        Scene changed = scene;
        changed.bodies[1].velocity[j] += step;
        return leastClearance(simulate(changed, contacts, 1.4), 1, bound, 0)->value;
      };
      const double h = 1e-4, narrow = (valueAt(h) - valueAt(-h)) / (2 * h);
      const double wide = (valueAt(2 * h) - valueAt(-2 * h)) / (4 * h);
      const double expected = (4 * narrow - wide) / 3;
      EXPECT_TRUE(std::abs(gradient[j] - expected) <= 1e-8)
          << rowName(bound.region, 0) << " at x = " << bound.region.position.x() << " by velocity " << j << ": "
          << gradient[j] << ", differences " << expected;
    }
  }
}

TEST_P(CurvedRegion, AnEditIsKeptOutOfOne) {
  const Scene scene = acrossASlope(GetParam());
  OdeContacts contacts(scene);
  const Vec3 end = simulate(scene, contacts, 1.4).stateAt("body", 1.4).position;
  Region post;
  post.shape = Sphere{0.1};
  post.position = simulate(scene, contacts, 1.4).stateAt("body", 0.5).position + Vec3(0, -0.05, 0);
  Edit edit(scene, contacts, 1.4);
  edit.vary(velocity("body").only({"x", "y"}));
  edit.nail("body", 1.4).position({end.x() + 0.05, any, any});
  edit.nail("body", 0.0).avoid(post);
  const EditResult result = edit.solve();
  EXPECT_TRUE(result.solved()) << result.message;
  EXPECT_TRUE(result.scaled_residual <= 1e-9) << result.scaled_residual;
  const double margin = GetParam() ? 0.1 : Vec3(0.15, 0.1, 0.1).norm();
  double least = 1;
  for (int i = 0; i <= 20000; ++i)
    least = std::min(least, (result.motion.stateAt("body", 1.4 * i / 20000).position - post.position).norm());
  EXPECT_TRUE(least >= 0.1 + margin - 1e-8) << least;
  EXPECT_LT(result.iterations, 60);
}

}  // namespace
}  // namespace carom
