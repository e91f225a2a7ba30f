// SPDX-License-Identifier: MIT
// The least distance of two shapes over a span against closed forms, against dense sampling, and its derivative.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/derivative/adjoint.h"
#include "adjoint/motion/guard.hpp"
#include "adjoint/derivative/seed.hpp"
#include "adjoint/simulate/simulate.h"
#include "adjoint/base/errors.h"
#include "editing/edit.h"
#include "editing/problem/rows/closest_approach.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace test;

Motion play(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  return simulate(scene, contacts, duration);
}

Body shaped(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity, const Vec3& spin) {
  Body body;
  body.name = name, body.shape = shape, body.mass = 1, body.position = position, body.velocity = velocity;
  body.angular_velocity = spin;
  return body;
}

/// Two that do not see each other.
Scene ghosts(Body a, Body b) {
  a.collision_filter.systems = b.collision_filter.systems = {"ghosts"};
  a.collision_filter.not_collide_with = {"ghosts"};
  Scene scene;
  scene.bodies = {std::move(a), std::move(b)};
  return scene;
}

Shape anyShape(Random& random) {
  const double size = random.in(0.05, 0.3);
  switch (random.below(7)) {
    case 0: return Sphere{size};
    case 1: return Capsule{0.3 * size, 3 * size};
    case 2: return Cylinder{size, random.in(0.05, 0.8)};
    case 3: return Cone{size, random.in(0.1, 0.6)};
    case 4: {
      Compound compound;
      compound.parts = {{Box{{size, 0.1, 0.1}}, {0.2, 0, 0}}, {Sphere{0.5 * size}, {-0.2, 0.1, 0}}};
      return compound;
    }
    default: return Box{{size, random.in(0.05, 0.4), random.in(0.05, 0.6)}};
  }
}

Vec3 anyVector(Random& random, double size) {
  return {random.in(-size, size), random.in(-size, size), random.in(-size, size)};
}

Scene anyPassing(std::uint64_t seed) {
  Random random(seed);
  Body a = shaped("a", anyShape(random), {-1, random.in(-0.6, 0.6), random.in(-0.3, 0.6)},
                  {random.in(0.5, 3), random.in(-1, 1), random.in(0, 4)}, anyVector(random, seed % 5 == 0 ? 40 : 6));
  Body b = shaped("b", anyShape(random), {0.3, 0, 0}, anyVector(random, 0.7), anyVector(random, 6));
  a.orientation = Quat(1, random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)).normalized();
  if (seed % 3 == 0) b.velocity.setZero(), b.angular_velocity.setZero(), b.fixed = true;
  if (seed % 7 == 0) {
    b.shape = Plane{Vec3(0.3, 0.1, 1).normalized(), -0.7}, b.fixed = true;
    b.velocity.setZero(), b.angular_velocity.setZero();
  }
  return ghosts(a, b);
}

TEST(ClosestApproach, TwoBallsThatPass) {
  const Vec3 d(-1, 0.3, 0.1), v(2, 0.1, -0.4);
  const Motion motion =
      play(ghosts(shaped("a", Sphere{0.05}, d, v, Vec3::Zero()),
                  shaped("b", Sphere{0.08}, Vec3::Zero(), Vec3::Zero(), Vec3::Zero())), 1);
  const auto found = closestApproach(motion, 0, 1, 0, 1);
  ASSERT_TRUE(found);
  const double t = -d.dot(v) / v.squaredNorm();
  const Vec3 across = d + t * v;
  EXPECT_NEAR(found->time, t, 1e-14);
  EXPECT_NEAR(found->value(), across.norm() - 0.13, 1e-15);
  EXPECT_EQ(found->keeps, Clearance::Keeps::least);
  const SceneGradient gradient = adjoint(motion, found->seeds());
  expectEntries(gradient.bodies[0].velocity, t * across.normalized(), 1e-13, "by the velocity of a");
  expectEntries(gradient.bodies[1].position, -across.normalized(), 1e-13, "by the position of b");
  EXPECT_NEAR(found->seeds()[0].size[0], -1, 1e-15);
  EXPECT_NEAR(found->seeds()[1].size[0], -1, 1e-15);
}

TEST(ClosestApproach, ABoxThatTurnsOverAPlane) {
  Body floor;
  floor.name = "floor", floor.fixed = true, floor.shape = Plane{};
  Body box = shaped("box", Box{{0.4, 0.1, 0.2}}, {0, 0, 1}, Vec3::Zero(), {0, 2, 0});
  box.orientation = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitY()));
  Scene scene;
  scene.gravity.setZero();
  scene.bodies = {box, floor};
  const Motion motion = play(scene, 1.5);
  const auto found = closestApproach(motion, 0, 1, 0, 1.5);
  ASSERT_TRUE(found);
  // a corner is below the centre where the box has turned by atan(0.4/0.2)
  EXPECT_NEAR(found->value(), 1 - std::hypot(0.2, 0.1), 1e-15);
  EXPECT_NEAR(found->time, (std::atan(2.0) - 0.1) / 2, 1e-13);
  EXPECT_TRUE(found->nearest.several) << "two corners are as low";
  const Vec3 by_size(-0.2 / std::hypot(0.2, 0.1) / 2, 0, -0.1 / std::hypot(0.2, 0.1) / 2);
  expectEntries(found->seeds()[0].size, by_size, 1e-13, "by the size");
  // up to before that, the end of the span counts
  const auto before = closestApproach(motion, 0, 1, 0, 0.3);
  ASSERT_TRUE(before);
  EXPECT_EQ(before->time, 0.3);
  EXPECT_EQ(before->keeps, Clearance::Keeps::place);
  EXPECT_NEAR(before->value(), 1 - (0.2 * std::sin(0.7) + 0.1 * std::cos(0.7)), 1e-15);
}

TEST(ClosestApproach, ARodPastAnEdge) {
  Body block;
  block.name = "block", block.fixed = true, block.shape = Box{{4, 2, 1}}, block.position = {0, -1, -0.5};
  const Body rod = shaped("rod", Capsule{0.02, 0.6}, {0.3, 0.1, 0.5}, {0.1, 0, -2}, Vec3::Zero());
  Body leaning = rod;
  const Vec3 along(0, 0.8, -0.6);
  leaning.orientation = Quat::FromTwoVectors(Vec3::UnitZ(), along);
  Scene scene = ghosts(leaning, block);
  scene.gravity = {0, 0, 5};
  const Motion motion = play(scene, 0.8);
  const auto found = closestApproach(motion, 0, 1, 0, 0.8);
  ASSERT_TRUE(found);
  const Vec3 n = Vec3::UnitX().cross(along) * -1;  // up and out of the edge along x at y = z = 0
  const Vec3 up = n.z() < 0 ? Vec3(-n) : n;
  EXPECT_NEAR(found->time, 0.4, 1e-13);
  EXPECT_NEAR(found->value(), up.dot(Vec3(0.34, 0.1, 0.5 - 0.4)) - 0.02, 1e-14);
}

TEST(ClosestApproach, NothingIsMissedBetweenSamples) {
  int apart = 0, inside = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const Motion motion = play(anyPassing(seed), 1);
    const auto found = closestApproach(motion, 0, 1, 0, 1);
    ASSERT_TRUE(found) << seed;
    const BodyDistance& distances = distancesOf(motion);
    for (int k = 0; k <= 300; ++k) {
      const Instant at = Instant::at(k / 300.0);
      const auto poseOf = [&](int body) { return shapePose(motion, body, readPlace(motion, body, at).state); };
      const Nearest here = distances.nearest(0, 1, poseOf(0), poseOf(1));
      EXPECT_FALSE(here.gap < found->value() - 1e-13) << seed << " at " << at.time << ": " << here.gap;
      EXPECT_TRUE(here.apart() || here.gap == 0) << seed << " at " << at.time << ": no features at " << here.gap;
    }
    EXPECT_LE(found->below, 1e-8) << seed;
    if (!found->nearest.apart()) continue;
    ++apart;
    inside += found->keeps == Clearance::Keeps::least;
  }
  EXPECT_GT(apart, 300);
  EXPECT_GT(inside, 150);
}

TEST(ClosestApproach, AnEditKeepsItsDistances) {
  Scene scene;
  scene.gravity.setZero();
  scene.bodies = {shaped("cue", Sphere{0.03}, {-1, 0.01, 0}, {2, 0, 0}, Vec3::Zero()),
                  shaped("red", Box{{0.2, 0.1, 0.1}}, {0, 0.4, 0}, Vec3::Zero(), {0, 0, 1}),
                  shaped("yellow", Capsule{0.02, 0.2}, {1, 0.5, 0}, Vec3::Zero(), {1, 0, 0})};
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("cue"));
  edit.nail("cue", 0.0).closestApproach("red", 0.21, std::pair{0.0, 0.9});
  edit.nail("cue", 0.9).distance("yellow", within(0.25, 0.3));
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  EXPECT_NEAR(closestApproach(r.motion, 0, 1, 0, 0.9)->value(), 0.21, 1e-9);
  const double distance = readDistance(r.motion, 0, 2, Instant::at(0.9)).value();
  EXPECT_TRUE(distance >= 0.25 - 1e-9 && distance <= 0.3 + 1e-9) << distance;
  for (const char* to : {"", "cue", "nobody"}) {
    Edit wrong(scene, contacts, 1);
    wrong.vary(velocity("cue"));
    wrong.nail("cue", 0.5).distance(to, 0.1);
    EXPECT_THROW(wrong.solve(), InputError) << to;
  }
  Edit touching(scene, contacts, 1);
  touching.vary(velocity("cue"));
  touching.nail("cue", 0.5).distance("red", 0.0);
  EXPECT_THROW(touching.solve(), InputError);
}

}  // namespace
}  // namespace carom
