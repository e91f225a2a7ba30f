// SPDX-License-Identifier: MIT
// Drags in scenes of many bodies, of which few matter: what is worked out with those alone is true of all.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/session.h"
#include "editing/session/session_part.hpp"
#include "tests/editing/session_scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_sessions;

void put(Scene& scene, const std::string& name, const Vec3& position, const Vec3& velocity) {
  Body body;
  body.name = name, body.material = "felt", body.density = 400, body.shape = Sphere{0.1};
  body.position = position, body.velocity = velocity;
  scene.bodies.push_back(body);
}

/// Balls in a row above a floor, far apart; "mover" flies along it and hits the "hit" one after 0.2 s; "wall" of the
/// third row is beside its way.
Scene rowOfBalls() {
  Scene scene;
  scene.materials = {{.name = "felt", .elasticity = 0.7, .friction = 0.3}};
  Body floor;
  floor.name = "floor", floor.fixed = true, floor.material = "felt", floor.shape = Plane{Vec3::UnitZ(), 0};
  scene.bodies.push_back(floor);
  put(scene, "mover", {0, 0, 1}, {2, 0, 1});
  put(scene, "hit", {0.6, 0, 1}, {0, 0, 1});
  put(scene, "beside", {1.1, 0.5, 1}, {0, 0, 1.5});
  for (int i = 0; i < 5; ++i) put(scene, "far " + std::to_string(i), {-1.0 - 0.5 * i, 0, 0.8}, {0, 0.1 * i, 0});
  return scene;
}

std::vector<Control> allVelocities(const Scene& scene) {
  std::vector<Control> controls;
  for (const Body& body : scene.bodies)
    if (!body.fixed) controls.push_back(velocity(body.name));
  return controls;
}

TEST(SessionParts, BodiesThatCountAreThoseThatMetBefore) {
  const Scene scene = rowOfBalls();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1.0, allVelocities(scene),
                            {nailConstraint("hit", 0.5, {.position = Vec3(0, 0, 1)})});
  EditPointPtr point = pointAt(problem, Eigen::VectorXd::Zero(problem.unknowns()), 1.0, true);
  EXPECT_EQ(bodiesThatCount(problem, *point),
            (std::vector<bool>{false, true, true, false, false, false, false, false, false}));
  point->changes[7] = 0.1;  // of "beside"
  EXPECT_TRUE(bodiesThatCount(problem, *point)[3]);

  const EditProblem earlier(scene, contacts, 1.0, allVelocities(scene),
                            {nailConstraint("hit", 0.05, {.position = Vec3(0, 0, 1)})});
  point = pointAt(earlier, Eigen::VectorXd::Zero(earlier.unknowns()), 1.0, true);
  EXPECT_FALSE(bodiesThatCount(earlier, *point)[1]) << "they had not met by then";
}

TEST(SessionParts, APartHasTheUnknownsOfTheWhole) {
  const Scene scene = rowOfBalls();
  OdeContacts contacts(scene);
  const std::vector<Constraint> held{nailConstraint("hit", 0.5, {.position = Vec3(0, 0, 1)})};
  const EditProblem whole(scene, contacts, 1.0, allVelocities(scene), held);
  ScenePart part = scenePart(whole, {false, false, true, false, false, true, false, false, false});
  EXPECT_EQ(part.moving, 2);
  EXPECT_EQ(part.all_moving, 8);
  ASSERT_EQ(part.scene.bodies.size(), 3u);
  EXPECT_EQ(part.scene.bodies[1].name, "hit");
  const EditProblem problem(part.scene, contacts, 1.0, part.controls, held);
  ASSERT_TRUE(matchUnknowns(whole, problem, part));
  EXPECT_EQ(part.unknowns, (std::vector<Eigen::Index>{3, 4, 5, 12, 13, 14}));
  Eigen::VectorXd changes = Eigen::VectorXd::LinSpaced(whole.unknowns(), 1, whole.unknowns());
  const Eigen::VectorXd own = part.restrict(changes);
  EXPECT_EQ(own[3], 13);
  part.extend(2 * own, changes);
  EXPECT_EQ(changes[12], 26);
  EXPECT_EQ(changes[11], 12);
}

TEST(SessionParts, WhatIsShownIsSimulatedWithAllBodies) {
  const Scene scene = rowOfBalls();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 1.0, allVelocities(scene), {}, withoutClock());
  session.grab("hit", 0.5);
  const Vec3 start = session.grabbedPlace();
  for (int k = 1; k <= 30; ++k) {
    // towards the ball beside its way, and through where that is
    const Vec3 target = start + k * Vec3(0.004, 0.018, 0.005);
    const SessionUpdate u = session.dragTo(target);
    const Motion again = simulate(u.scene(), contacts, 1.0);
    EXPECT_EQ(again.signature(), u.motion->signature()) << k;
    EXPECT_EQ(u.motion->scene->bodies.size(), scene.bodies.size());
    EXPECT_EQ(u.motion->duration, 1.0);
    const double away = (again.stateAt("hit", 0.5).position - target).norm();
    EXPECT_TRUE(std::abs(away - u.distance) <= 1e-12) << k << ": " << away << " " << u.distance;
    EXPECT_TRUE(u.reached) << k << " " << u.message;
    for (std::size_t b = 4; b < scene.bodies.size(); ++b)
      EXPECT_TRUE(sameBits(u.scene().bodies[b].velocity, scene.bodies[b].velocity)) << k << " " << b;
  }
  EXPECT_TRUE(session.release().reached);
}

// In a drag what nobody comes near is taken over from update to update; what stays owes nothing to the way there.
TEST(SessionParts, WhatStaysIsSimulatedAnew) {
  for (const MeasureFrom from : {MeasureFrom::grab, MeasureFrom::start}) {
    const Scene scene = rowOfBalls();
    OdeContacts contacts(scene);
    SessionOptions options = withoutClock();
    options.measure_from = from;
    EditSession session(scene, contacts, 1.0, allVelocities(scene), {}, options);
    session.grab("hit", 0.5);
    const Vec3 start = session.grabbedPlace();
    for (int k = 1; k <= 5; ++k) session.dragTo(start + k * Vec3(0.004, 0.01, 0.005));
    EXPECT_EQ(session.motion().taken_over, 6u) << "all but the two that meet";
    for (const SessionUpdate& u : {session.release(), session.undo(), session.redo()}) {
      EXPECT_EQ(u.motion->taken_over, 0u);
      const Motion again = simulate(u.scene(), contacts, 1.0);
      for (std::size_t b = 1; b < scene.bodies.size(); ++b) {
        const BodyState is = u.motion->stateAt(static_cast<int>(b), 1.0), was = again.stateAt(static_cast<int>(b), 1.0);
        EXPECT_TRUE(sameBits(is.position, was.position)) << scene.bodies[b].name;
        EXPECT_TRUE(sameBits(is.angular_velocity, was.angular_velocity)) << scene.bodies[b].name;
      }
    }
    expectSameAgain(session, scene);
  }
}

TEST(SessionParts, AMotionThatEndsEarlySaysSo) {
  Scene scene = rowOfBalls();
  scene.materials[0].elasticity = 0;
  // a belt carries both to its end, where they would move on each other
  Body belt = test::fixedBody(test::makeBox("belt", {2, 2, 0.2}, {0, 50, 5}));
  belt.surface_velocity = {0.5, 0, 0};
  belt.material = scene.bodies[1].material;
  scene.bodies.push_back(belt);
  double height = 5.2;
  for (const std::size_t b : {1u, 2u}) {
    scene.bodies[b].shape = Box{Vec3(0.2, 0.2, 0.2)};
    scene.bodies[b].position = {0.4, 50, height}, scene.bodies[b].velocity = {0.5, 0, 0}, scene.bodies[b].angular_velocity.setZero();
    height += 0.2;
  }
  for (int i = 0; i < 7; ++i) {  // more bodies than move on each other
    Body plate = scene.bodies[1];
    plate.name = "plate " + std::to_string(i);
    plate.shape = Box{Vec3(0.2, 0.2, 0.02)};
    plate.position.z() = 5.51 + 0.02 * i;
    scene.bodies.push_back(plate);
  }
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 3.0, withoutClock());
  session.setControls({velocity("hit")});
  ASSERT_LT(session.motion().end, 3.0);
  EXPECT_NE(session.last().message.find("The motion ends at"), std::string::npos) << session.last().message;
  EXPECT_NE(session.last().message.find("'mover' and 'hit' rest on each other, on 'belt'."), std::string::npos)
      << "no digits that nobody reads: " << session.last().message;
  try {
    session.grab("hit", 2.9);
    FAIL() << "expected InputError";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected a time in the motion"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("The motion ends at"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(session.isGrabbed());
}

TEST(Budget, IsCountedByItsPriceAndCutByTheRecord) {
  Budget budget(2);
  budget.setPrice(0.25, 1);
  EXPECT_EQ(budget.left(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(budget.take()) << i;
  EXPECT_FALSE(budget.take());
  EXPECT_FALSE(budget.cutAfter().has_value());
  budget.setPrice(1, 0);
  budget.count(1);
  EXPECT_FALSE(budget.take());
  EXPECT_EQ(budget.done(), 5);

  Budget replayed = Budget::replayed(10, 2);
  EXPECT_TRUE(replayed.take() && replayed.take());
  EXPECT_FALSE(replayed.take());
  replayed.count(1);
  EXPECT_EQ(replayed.cutAfter(), 2);
  EXPECT_EQ(replayed.done(), 3);

  Budget late(10, 0);
  EXPECT_FALSE(late.take());
  EXPECT_EQ(late.cutAfter(), 0);
}

}  // namespace
}  // namespace carom
