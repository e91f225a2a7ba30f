// SPDX-License-Identifier: MIT
// Edits that no motion meets, each proven; and a sweep of edits that a motion is known to meet, none of which is called so.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "editing/strategy/energy_bounds.hpp"
#include "editing/strategy/proven_bounds.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace editing_detail;

namespace {

Body solidBody(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity) {
  Body body;
  body.name = name, body.shape = shape, body.material = "m", body.position = position, body.velocity = velocity;
  body.mass = 0.3;
  return body;
}

Body ground() {
  Body floor = solidBody("floor", Plane{}, Vec3::Zero(), Vec3::Zero());
  floor.fixed = true, floor.mass.reset();
  return floor;
}

Scene ballAndOther() {
  return test::makeScene({0, 0, -9.81}, 0.7, 0.3,
                         {ground(), solidBody("ball", Sphere{0.05}, {-0.8, 0, 1}, {2, 0, 0.9}),
                          solidBody("other", Sphere{0.05}, {1, 1.5, 0.05}, Vec3::Zero())});
}

EditResult solved(const Scene& scene, std::vector<Control> controls, const Constraint& constraint) {
  OdeContacts contacts(scene);
  return Edit(scene, contacts, 2, std::move(controls), {constraint}).solve({.effort = Effort::fast});
}

Constraint hitOf(const std::string& body, const std::string& other) {
  Constraint c{body, 0.0, {}};
  c.hits = Hit{other};
  return c;
}

Constraint heightOf(const std::string& body, When at, double z) {
  Constraint c{body, at, {}};
  c.targets = {Target{"position", {any, any, z}}};
  return c;
}

/// Of the proofs alone, without a search.
std::string proofOf(const Scene& scene, const std::vector<Control>& controls, const Constraint& constraint) {
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 2, controls, {constraint});
  return whyTheyNeverMeet(problem) + whyItCannotRest(problem, 1e-9) + whyItIsTooHigh(problem, 1e-9);
}

void expectProven(const EditResult& r, const std::string& sentence) {
  EXPECT_EQ(r.status, EditStatus::infeasible) << r.message;
  EXPECT_EQ(r.message.substr(0, sentence.size()), sentence);
}

TEST(ProvenBounds, FiltersKeepBodiesApart) {
  Scene scene = ballAndOther();
  scene.bodies[1].collision_filter.systems = {"a"};
  scene.bodies[2].collision_filter.not_collide_with = {"a"};
  expectProven(solved(scene, {velocity("ball")}, hitOf("ball", "other")),
               "'ball' and 'other' never collide: their collision filters keep them apart.");
}

TEST(ProvenBounds, NothingBearsARestInTheAir) {
  Scene scene = test::makeScene({0, 0, -9.81}, 0.2, 0.5,
                                {ground(), solidBody("die", Box{{0.03, 0.03, 0.03}}, {-0.3, 0, 0.15}, {1, 0, 0.3})});
  When rest(0.0);
  rest.rest = true;
  EXPECT_EQ(proofOf(scene, {velocity("die"), angularVelocity("die")}, heightOf("die", rest, 0.3)),
            "'die' cannot rest there: it reaches 0.026 m from its origin at most, and the nearest that can "
            "carry it, 'floor', is 0.3 m away.");
  EXPECT_EQ(proofOf(scene, {velocity("die")}, heightOf("die", rest, 0.015)), "");
  // A shelf that varies may come to it, and so may a body that moves.
  Body shelf = solidBody("shelf", Box{{0.2, 0.2, 0.02}}, {3, 0, 0.1}, Vec3::Zero());
  shelf.fixed = true, shelf.mass.reset();
  scene.bodies.push_back(shelf);
  EXPECT_EQ(proofOf(scene, {velocity("die"), position("shelf")}, heightOf("die", rest, 0.3)), "");
}

TEST(ProvenBounds, EnergyLiftsABallSoHigh) {
  const Scene scene = ballAndOther();  // 1 m, and (4 + 0.81)/2g = 0.2452 m more; the other one lies on the floor
  const std::vector<Control> controls{elasticity("m"), friction("m")};
  expectProven(solved(scene, controls, heightOf("ball", 1.3, 1.35)),
               "'ball' has energy for a height of 1.3 m at most; 1.35 m is asked (position.z of 'ball' at 1.3 s).");
  EXPECT_EQ(proofOf(scene, controls, heightOf("ball", 1.3, 1.29)), "");
  EXPECT_EQ(proofOf(scene, {velocity("ball")}, heightOf("ball", 1.3, 1.35)), "") << "a throw has no bound";
  EXPECT_EQ(proofOf(scene, {velocity("ball").within(-3, 3)}, heightOf("ball", 1.3, 1.35)), "");
  EXPECT_NE(proofOf(scene, {velocity("ball").within(-3, 3)}, heightOf("ball", 1.3, 2.5)), "");
}

// A hidden change of the coefficients gives the height that is asked for, in scenes of two balls or boxes that meet.
TEST(ProvenBounds, WhatAMotionMeetsIsNeverCalledImpossible) {
  int high = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    test::Random random(seed);
    const bool box = random.below(2) == 0;
    const Shape shape = box ? Shape(Box{{0.1, 0.14, 0.2}}) : Shape(Sphere{0.1});
    Scene hidden = test::makeScene({0, 0, -9.81}, 1, random.in(0, 0.5),
                                   {ground(), solidBody("a", shape, {-0.5, 0, random.in(0.3, 1)}, {random.in(0.5, 2), 0, 1}),
                                    solidBody("b", shape, {0.4, random.in(-0.05, 0.05), random.in(0.3, 1)}, {random.in(-2, 0), 0, 0})});
    hidden.bodies[1].mass = random.in(0.1, 3), hidden.bodies[2].mass = random.in(0.1, 3);
    const double duration = 1.2;
    const Motion motion = test::play(hidden, duration);
    if (motion.status != MotionStatus::complete) continue;
    double highest = 0, at = 0;
    for (int k = 1; k < 200; ++k) {
      const double t = duration * k / 200, z = motion.stateAt("a", t).position.z();
      if (z > highest) highest = z, at = t;
    }
    if (highest > hidden.bodies[1].position.z() + 0.1) ++high;
    Scene start = hidden;
    start.materials[0].elasticity = 0.6;
    EXPECT_EQ(proofOf(start, {elasticity("m")}, heightOf("a", at, highest)), "");
  }
  EXPECT_GE(high, 5);
}

}  // namespace
}  // namespace carom
