// SPDX-License-Identifier: MIT
// What lies or slides on a face and is struck from the side: the contacts that are held have impulses of rounding only,
// of either sign, and must not become a support of friction.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

namespace carom {
namespace {

Scene stoneAndBoard() {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[0].name = "ice", scene.materials[0].elasticity = 0.2, scene.materials[0].friction = 0.01;
  scene.materials[1].name = "granite", scene.materials[1].elasticity = 0.8, scene.materials[1].friction = 0.2;
  scene.materials[2].name = "board", scene.materials[2].elasticity = 0.6, scene.materials[2].friction = 0;
  for (Material& material : scene.materials) material.combine_friction = Combine::minimum;
  Body ice, board, stone;
  ice.name = "ice", ice.fixed = true, ice.material = "ice", ice.shape = Plane{};
  board.name = "board", board.fixed = true, board.material = "board", board.shape = Box{{14, 0.1, 0.3}};
  board.position = {5, 1.6, 0.15};
  stone.name = "stone", stone.material = "granite", stone.mass = 19, stone.shape = Cylinder{0.145, 0.11};
  stone.position = {0, 0, 0.075}, stone.velocity = {1.4, 0.47, 0};
  scene.bodies = {ice, board, stone};
  return scene;
}

// Dropped from 2 cm, so that its pose has the rounding of twenty bounces.
TEST(ConstrainedContacts, ABoardWithoutFrictionTurnsOnlyTheSpeedTowardsIt) {
  for (int i = -20; i <= 20; ++i) {
    Scene scene = stoneAndBoard();
    scene.bodies[2].velocity.y() += 1e-3 * i;
    OdeContacts contacts(scene);
    const Motion motion = simulate(scene, contacts, 20);
    ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
    const auto event = motion.findImpact(2, 1, 1);
    ASSERT_TRUE(event.has_value());
    const double time = motion.events[static_cast<std::size_t>(*event)].time;
    const Vec3 before = motion.stateBefore(*event, 2).velocity, after = motion.stateAt(2, time).velocity;
    EXPECT_TRUE(std::abs(after.x() - before.x()) <= 1e-12) << i << ": " << before.x() << " becomes " << after.x();
    EXPECT_TRUE(std::abs(after.y() + 0.7 * before.y()) <= 1e-12) << i << ": " << before.y() << " becomes " << after.y();
  }
}

TEST(ConstrainedContacts, StonesWithoutFrictionBetweenThemKeepTheirMomentum) {
  for (int i = 0; i <= 40; ++i) {
    Scene scene = stoneAndBoard();
    scene.bodies[1] = scene.bodies[2];
    scene.bodies[1].name = "other", scene.bodies[1].material = "board";
    scene.bodies[1].position = {2, 0.02, 0.055}, scene.bodies[1].velocity = {0, 0, 0};
    scene.bodies[2].position = {0, 0, 0.055}, scene.bodies[2].velocity = {1.3, 1e-3 * i, 0};
    OdeContacts contacts(scene);
    const Motion motion = simulate(scene, contacts, 8);
    ASSERT_EQ(motion.status, MotionStatus::complete) << i << ": " << motion.message;
    const auto event = motion.findImpact(2, 1, 1);
    ASSERT_TRUE(event.has_value());
    const double time = motion.events[static_cast<std::size_t>(*event)].time;
    const Vec3 before = motion.stateBefore(*event, 2).velocity;
    const Vec3 after = motion.stateAt(1, time).velocity + motion.stateAt(2, time).velocity;
    EXPECT_TRUE((after - before).norm() <= 1e-12) << i << ": " << before.transpose() << " becomes " << after.transpose();
  }
}

// Faster than any series can follow; where nobody asks how the ball has turned, nothing has to be followed.
TEST(ConstrainedContacts, ABallThatRollsFasterThanItsTurnCanBeFollowedEndsTheMotion) {
  Scene scene = stoneAndBoard();
  scene.gravity = {0, 1, -9.7};
  scene.bodies.erase(scene.bodies.begin() + 1);
  scene.materials[0].friction = 0.5, scene.materials[1].friction = 0.5;
  Body& ball = scene.bodies[1];
  ball.shape = Sphere{0.02}, ball.position = {0, 0, 0.02}, ball.velocity = {1e4, 0, 0};
  ball.angular_velocity = {0, 5e5, 0};
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 10);
  EXPECT_EQ(motion.status, MotionStatus::not_computable) << motion.message;
  EXPECT_LT(motion.end, 10);
}

}  // namespace
}  // namespace carom
