// SPDX-License-Identifier: MIT
// Proofs by energy and by free flight: each of their conditions counts, and what a motion meets is never called impossible.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/strategy/energy_bounds.hpp"
#include "editing/strategy/free_flight.hpp"
#include "editing/strategy/kept_coordinates.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace editing_detail;
using test::Random;

namespace {

Body thing(const std::string& name, const Shape& shape, const Vec3& position, const Vec3& velocity) {
  Body body;
  body.name = name, body.shape = shape, body.material = "m", body.position = position, body.velocity = velocity, body.mass = 0.3;
  return body;
}

Scene above(double friction, std::vector<Body> bodies) {
  Body floor = thing("floor", Plane{}, Vec3::Zero(), Vec3::Zero());
  floor.fixed = true, floor.mass.reset();
  bodies.insert(bodies.begin(), floor);
  return test::makeScene({0, 0, -9.81}, 0.7, friction, bodies);
}

Scene tossed() { return above(0.3, {thing("a", Box{{0.1, 0.14, 0.2}}, {0, 0, 1.5}, {1, 0, 0})}); }

Constraint wanted(double t, Target target) { return {"a", t, {std::move(target)}}; }

std::string flightProof(const Scene& scene, const std::vector<Control>& controls, const Constraint& constraint) {
  OdeContacts contacts(scene);
  return whyItStaysAway(EditProblem(scene, contacts, 2, controls, {constraint}), 1e-9);
}

std::string energyProof(const Scene& scene, const std::vector<Control>& controls, const std::vector<Constraint>& constraints) {
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 2, controls, constraints);
  return whyItIsTooHigh(problem, 1e-9) + whyItIsTooFast(problem, 1e-9) + whyItIsTooFar(problem, 1e-9);
}

const Control kSlow = velocity("a").within(-2, 2);

// 1.5 m above the floor, with at most 2 m/s downwards, a box of a radius of 0.14 m touches nothing for 0.36 s.
TEST(FreeFlight, ABoundedThrowLeadsSoFar) {
  const Scene scene = tossed();
  EXPECT_EQ(flightProof(scene, {kSlow}, wanted(0.3, {"position", {0.9, any, any}})),
            "Position.x of 'a' at 0.3 s comes to 0.6 m at most; 0.9 m is asked: velocity.x of 'a' lies between -2 and 2 m/s, and it "
            "meets nothing before.");
  EXPECT_NE(flightProof(scene, {kSlow}, wanted(0.3, {"position", {any, -0.61, any}})), "");
  EXPECT_NE(flightProof(scene, {kSlow}, wanted(0.3, {"position", {any, any, 1.67}})), "");
  EXPECT_NE(flightProof(scene, {kSlow}, wanted(0.3, {"velocity", {any, any, -5}})), "");
  EXPECT_EQ(flightProof(scene, {kSlow}, wanted(0.3, {"position", {0.59, -0.59, 1.65}})), "");
  EXPECT_EQ(flightProof(scene, {kSlow}, wanted(0.3, {"velocity", {any, any, -4.9}})), "");
  EXPECT_EQ(flightProof(scene, {kSlow}, wanted(0.5, {"position", {1.1, any, any}})), "") << "it may bounce";
}

TEST(FreeFlight, EachConditionCounts) {
  const Constraint far = wanted(0.3, {"position", {0.9, any, any}});
  const auto with = [&](const auto& change, std::vector<Control> controls) {
    Scene scene = tossed();
    change(scene);
    return flightProof(scene, controls, far);
  };
  const auto same = [](Scene&) {};
  EXPECT_NE(with(same, {kSlow, angularVelocity("a"), orientation("a"), mass("a"), elasticity("m")}), "");
  EXPECT_EQ(with(same, {velocity("a")}), "");
  EXPECT_EQ(with(same, {kSlow, gravity()}), "");
  EXPECT_EQ(with(same, {kSlow, size("a")}), "");
  EXPECT_EQ(with(same, {kSlow, position("a")}), "");
  EXPECT_NE(with(same, {kSlow, position("a").only({"x"}).within(-0.2, 0.2)}), "");
  EXPECT_EQ(with(same, {kSlow, position("a").only({"x"}).within(-0.2, 0.3)}), "");
  EXPECT_EQ(with(same, {kSlow, position("floor").only({"z"})}), "");
  EXPECT_EQ(with(same, {kSlow, orientation("floor")}), "");
  EXPECT_EQ(with([](Scene& s) { s.bodies[1].position.z() = 1; }, {kSlow}), "") << "it may bounce before";
  const auto other = [](const Vec3& place, const Vec3& v) {
    return [=](Scene& s) { s.bodies.push_back(thing("b", Sphere{0.1}, place, v)); };
  };
  EXPECT_EQ(with(other({0.5, 0, 1.5}, Vec3::Zero()), {kSlow}), "");
  EXPECT_EQ(with(other({4, 0, 1.5}, {-12, 0, 0}), {kSlow}), "");
  EXPECT_NE(with(other({4, 0, 1.5}, {-2, 0, 0}), {kSlow}), "");
  EXPECT_EQ(with(other({4, 0, 0.2}, {-2, 0, -1}), {kSlow}), "") << "it bounces, and who knows whereto";
  EXPECT_NE(with([](Scene& s) { s.bodies[1].center_of_mass = Vec3(0.01, 0, 0); }, {kSlow}), "");
  EXPECT_EQ(with([](Scene& s) { s.bodies[1].center_of_mass = Vec3(0.15, 0, 0); }, {kSlow}), "") << "the origin may turn about it";
}

TEST(EnergyBounds, NothingIsFasterThanAllTheEnergyMakesIt) {
  const Scene scene = tossed();
  // sqrt(3 * 4 + 2 * 9.81 * 1.5) = 6.437 m/s
  EXPECT_EQ(energyProof(scene, {kSlow}, {wanted(1, {"speed", {7}})}),
            "'a' has energy for 6.44 m/s at most; 7 m/s is asked (speed of 'a' at 1 s).");
  EXPECT_EQ(energyProof(scene, {kSlow}, {wanted(1, {"speed", {6.43}})}), "");
  EXPECT_NE(energyProof(scene, {kSlow}, {wanted(1, {"velocity", {any, any, -6.5}})}), "");
  EXPECT_EQ(energyProof(scene, {kSlow}, {wanted(1, {"velocity", {any, any, -6.4}})}), "");
  EXPECT_NE(energyProof(scene, {kSlow}, {wanted(1, {"kinetic_energy", {0.5 * 0.3 * 6.5 * 6.5}})}), "");
  EXPECT_NE(energyProof(scene, {kSlow}, {wanted(1, {"angular_velocity", {200, any, any}})}), "");
  EXPECT_EQ(energyProof(scene, {kSlow}, {wanted(1, {"angular_velocity", {100, any, any}})}), "");
  EXPECT_EQ(energyProof(scene, {velocity("a")}, {wanted(1, {"speed", {7}})}), "") << "any velocity";
  EXPECT_EQ(energyProof(scene, {kSlow, mass("a")}, {wanted(1, {"speed", {7}})}), "");
  Scene without = scene;
  without.bodies[0].orientation = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitX()));
  EXPECT_EQ(energyProof(without, {kSlow}, {wanted(1, {"speed", {7}})}), "") << "it may fall along a slope";
}

TEST(EnergyBounds, NothingGetsFartherThanThat) {
  const Scene scene = tossed();
  const auto at = [](double t, double x) { return wanted(t, {"position", {x, any, any}}); };
  EXPECT_EQ(energyProof(scene, {kSlow}, {at(0.5, 3.3)}),
            "'a' has energy for 6.44 m/s at most, which takes it 3.22 m by 0.5 s; the place that is asked for "
            "is 3.3 m from its start.");
  EXPECT_EQ(energyProof(scene, {kSlow}, {at(0.5, 3.2)}), "");
  EXPECT_NE(energyProof(scene, {kSlow}, {at(0.5, 0.5), at(0.55, 0.9)}), "");
  EXPECT_EQ(energyProof(scene, {kSlow}, {at(0.5, 0.5), at(0.6, 1.1)}), "");
  Constraint some = at(0, 0.5);
  some.at = between(0.3, 0.5);
  EXPECT_EQ(energyProof(scene, {kSlow}, {some, at(0.55, 0.9)}), "");
  EXPECT_NE(energyProof(scene, {kSlow}, {some, at(0.55, 2.3)}), "");
}

// Numbers of hidden motions within the bounds, asked of another start.
TEST(ReachProofs, WhatAHiddenMotionMeetsIsNeverCalledImpossible) {
  int compared = 0, flying = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const double z = random.in(0.3, 2);
    const Vec3 v(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2));
    const Shape shape = random.below(2) == 0 ? Shape(Box{{0.1, 0.14, 0.2}}) : Shape(Sphere{0.1});
    const double x = random.in(0.4, 1.5), height = random.in(0.11, 1.5), speed = random.in(-3, 0);
    Scene hidden = above(random.in(0, 0.8), {thing("a", shape, {0, 0, z}, v), thing("b", Sphere{0.1}, {x, 0, height}, {speed, 0, 0})});
    hidden.bodies[1].angular_velocity = Vec3(random.in(-9, 9), random.in(-9, 9), random.in(-9, 9));
    const Motion motion = test::play(hidden, 2);
    if (motion.status != MotionStatus::complete) continue;
    Scene start = hidden;
    start.bodies[1].velocity = Vec3(random.in(-2, 2), 0, 0);
    const double t = random.in(0.02, 1);
    const BodyState state = motion.stateAt("a", t), later = motion.stateAt("a", 2 * t);
    if (!(state.velocity.norm() > 0)) continue;  // a speed of 0 cannot be asked for
    const auto vec = [](const Vec3& x) { return std::vector<TargetNumber>{x.x(), x.y(), x.z()}; };
    const std::vector<Constraint> all{wanted(t, {"position", vec(state.position)}), wanted(t, {"velocity", vec(state.velocity)}),
                                      wanted(t, {"angular_velocity", vec(state.angular_velocity)}),
                                      wanted(t, {"speed", {state.velocity.norm()}}),
                                      wanted(2 * t, {"position", vec(later.position)})};
    OdeContacts contacts(start);
    const EditProblem problem(start, contacts, 2, {kSlow}, all);
    EXPECT_EQ(whyItStaysAway(problem, 1e-9), "");
    EXPECT_EQ(whyItIsTooHigh(problem, 1e-9) + whyItIsTooFast(problem, 1e-9) + whyItIsTooFar(problem, 1e-9), "");
    ++compared;
    flying += freeFlightUntil(problem, 1, t).has_value();
  }
  EXPECT_GE(compared, 400);
  EXPECT_GE(flying, 30);
}

}  // namespace
}  // namespace carom
