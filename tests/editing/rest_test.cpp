// SPDX-License-Identifier: MIT
// Constraints on bodies that have come to rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/edit.h"
#include "editing/problem/jacobian.hpp"
#include "editing/problem/rows/instants.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

constexpr double kPull = 9.81, kFriction = 0.25;

Body block(const std::string& name, const Vec3& position, const Vec3& velocity) {
  Body body;
  body.name = name;
  body.material = "wood";
  body.shape = Box{{0.2, 0.3, 0.1}};
  body.mass = 1.3;
  body.position = position;
  body.velocity = velocity;
  return body;
}

/// A floor, and on it, or above it, these.
Scene onFloor(std::vector<Body> bodies, double friction = kFriction) {
  Scene scene;
  scene.materials = {material("wood", 0.3, friction)};
  scene.bodies = {fixedPlane("floor", "wood", Vec3::UnitZ(), 0)};
  for (Body& body : bodies) scene.bodies.push_back(std::move(body));
  return scene;
}

Scene sliding(const Vec3& velocity = {1.2, 0.3, 0}) { return onFloor({block("block", {0.1, 0, 0.05}, velocity)}); }

Vec3 velocityOf(const EditResult& result, const std::string& body) {
  return result.scene.bodies[static_cast<std::size_t>(bodyIndex(result.scene, body))].velocity;
}

/// The throw on the floor after which a body has come so far when friction has stopped it: v^2 / (2 mu g).
Vec3 throwOver(const Vec3& way) { return std::sqrt(2 * kFriction * kPull * way.norm()) * way.normalized(); }

TEST(AtRest, ABlockStopsOnAMark) {
  for (const bool reversed : {false, true}) {
    Scene scene = sliding();
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    OdeContacts contacts(scene);
    Edit edit(scene, contacts, 4);
    edit.vary(velocity("block").only({"x", "y"}));
    edit.nail("block", atRest()).position(1.5, 0.4, any);
    const EditResult result = edit.solve();
    ASSERT_EQ(result.status, EditStatus::solved) << result.message;
    EXPECT_TRUE((velocityOf(result, "block") - throwOver({1.4, 0.4, 0})).norm() <= 1e-9)
        << velocityOf(result, "block").transpose();
    EXPECT_EQ(result.residuals[0].name, "position.x of 'block' at rest");
    ASSERT_EQ(result.times.size(), 1u);
    EXPECT_EQ(result.times[0].name, "'block' at rest");
    const double stops = throwOver({1.4, 0.4, 0}).norm() / (kFriction * kPull);
    EXPECT_TRUE(std::abs(result.times[0].time - stops) <= 1e-9) << result.times[0].time;
    EXPECT_EQ(result.times[0].from, 0);
    EXPECT_EQ(result.times[0].to, 4);
  }
}

// Of what falls flat and slides all the while, friction takes mu m g of the momentum a second, whatever the bounces.
TEST(AtRest, ABlockThatFallsStopsWhenFrictionHasTakenItsMomentum) {
  const Scene scene = onFloor({block("block", {0, 0, 0.5}, {2, 0.3, 0})});
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 3);
  edit.vary(velocity("block").only({"x", "y"}));
  edit.nail("block", atRest()).time(0.9).position(any, 0.2, any);
  const EditResult result = edit.solve();
  ASSERT_TRUE(result.solved()) << result.message;
  const Vec3 v = velocityOf(result, "block");
  EXPECT_TRUE(std::abs(v.norm() - 0.9 * kFriction * kPull) <= 1e-9) << v.norm();
  EXPECT_TRUE(std::abs(result.motion.stateAt("block", 3).position.y() - 0.2) <= 1e-9);
}

TEST(AtRest, ABallThatBouncesToRestLiesOnItsMark) {
  const Scene scene = onFloor({ball("ball", "wood", 0.1, {0.2, 0.1, 0.8}, Vec3::Zero())});
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 3);
  edit.vary(position("ball"));
  edit.nail("ball", atRest()).position(0.5, -0.2, any);
  const EditResult result = edit.solve();
  ASSERT_EQ(result.status, EditStatus::solved) << result.message;
  const Vec3 start = result.scene.bodies[1].position;
  EXPECT_TRUE((start - Vec3(0.5, -0.2, 0.8)).norm() <= 1e-9) << start.transpose();
  EXPECT_TRUE(result.motion.stateAt("ball", 3).velocity.isZero(0));
}

TEST(AtRest, WhatRestsFromTheStartIsReadThere) {
  const Scene scene = sliding(Vec3::Zero());
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1);
  const auto instant = findRest(motion, 1);
  ASSERT_TRUE(instant);
  EXPECT_EQ(timeOf(motion, *instant), 0);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("block").only({"x", "y"}));
  edit.nail("block", atRest()).position(0.1, 0, any);
  const EditResult stays = edit.solve();
  EXPECT_EQ(stays.status, EditStatus::solved) << stays.message;
  EXPECT_EQ(stays.objective, 0);
}

TEST(AtRest, WhatRestsFromTheStartIsMovedByAThrow) {
  const Scene scene = sliding(Vec3::Zero());
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 3);
  edit.vary(velocity("block").only({"x", "y"}));
  edit.nail("block", atRest()).position(0.9, 0.3, any);
  const EditResult result = edit.solve();
  ASSERT_TRUE(result.solved()) << result.message;
  EXPECT_TRUE((velocityOf(result, "block") - throwOver({0.8, 0.3, 0})).norm() <= 1e-9);
}

TEST(AtRest, ARestThatTheStartLacksIsLookedFor) {
  const Scene scene = sliding({9, 0, 0});  // stops after 3.7 s
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("block").only({"x", "y"}));
  edit.nail("block", atRest()).position(2, 0.3, any);
  const EditResult result = edit.solve();
  ASSERT_EQ(result.status, EditStatus::solved_sequence_changed) << result.message;
  EXPECT_TRUE((velocityOf(result, "block") - throwOver({1.9, 0.3, 0})).norm() <= 1e-9);
  EditOptions stays;
  stays.sequence = SequencePolicy::stay;
  const EditResult none = edit.solve(stays);
  EXPECT_EQ(none.status, EditStatus::bad_start);
  EXPECT_EQ(none.message, "'block' does not come to rest within 2 s.");
}

TEST(AtRest, ARestThatNeverComesIsTold) {
  const Scene scene = onFloor({block("block", {0, 0, 0.05}, {1, 0, 0})}, 0);
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("block").only({"x"}).within(0.5, 2));
  edit.nail("block", atRest()).position(1, any, any);
  EditOptions fast;
  fast.effort = Effort::fast;
  const EditResult result = edit.solve(fast);
  EXPECT_EQ(result.status, EditStatus::not_converged);
  const std::string lacks = "'block' does not come to rest within 2 s.";
  const std::size_t said = result.message.find(lacks);
  ASSERT_NE(said, std::string::npos) << result.message;
  EXPECT_EQ(result.message.find(lacks, said + 1), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("The slowest ends with 0.5"), std::string::npos) << result.message;
}

// On a table or beside it: the height at rest has no gradient, and samples find the other one.
TEST(AtRest, AnOutcomeOfFewValuesIsFound) {
  Scene scene = onFloor({ball("ball", "wood", 0.1, {0.2, 0, 0.8}, Vec3::Zero())});
  Body table = block("table", {0, 0, 0.1}, Vec3::Zero());
  table.fixed = true, table.shape = Box{{1, 1, 0.2}};
  scene.bodies.push_back(table);
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 3);
  edit.vary(position("ball").only({"x", "y"}));
  edit.nail("ball", atRest()).position(any, any, 0.1);
  const EditResult result = edit.solve();
  ASSERT_EQ(result.status, EditStatus::solved_sequence_changed) << result.message;
  const Vec3 start = result.scene.bodies[1].position;
  EXPECT_GE(std::max(std::abs(start.x()), std::abs(start.y())), 0.5) << start.transpose();
  EXPECT_LE((start - scene.bodies[1].position).norm(), 0.5) << "0.4 is the smallest that there is";
}

/// A block that stops, and a ball without friction.
Scene withBall(const Vec3& block_velocity, const Vec3& ball_position, const Vec3& ball_velocity) {
  Scene scene = onFloor({block("block", {0, 0, 0.05}, block_velocity),
                         ball("ball", "rubber", 0.05, ball_position, ball_velocity)});
  Material rubber = material("rubber", 1, 0);
  rubber.combine_elasticity = Combine::maximum, rubber.combine_friction = Combine::minimum;
  scene.materials.push_back(rubber);
  return scene;
}

TEST(AtRest, AHitThatLeavesItAtRestDoesNotCount) {
  Scene scene = withBall({0.4, 0, 0}, {0, 0, 0.9}, Vec3::Zero());
  scene.bodies[1].position.x() = -0.4 * 0.4 / (2 * kFriction * kPull);
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.6);
  ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
  const int body = bodyIndex(scene, "block");
  const std::vector<Arc>& arcs = motion.world_lines[static_cast<std::size_t>(body)].arcs;
  ASSERT_GE(arcs.size(), 4u);
  EXPECT_EQ(arcs.back().kind(), ArcKind::rest);
  EXPECT_EQ(arcs[arcs.size() - 2].kind(), ArcKind::rest) << "the ball hits it while it rests";
  const auto instant = findRest(motion, body);
  ASSERT_TRUE(instant && instant->follows);
  EXPECT_TRUE(std::abs(timeOf(motion, *instant) - 0.4 / (kFriction * kPull)) <= 1e-12) << timeOf(motion, *instant);
}

TEST(AtRest, AHitThatMovesItPutsItOff) {
  const Scene scene = withBall({0.3, 0, 0}, {-2, 0, 0.05}, {4, 0, 0});
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 2);
  const int body = bodyIndex(scene, "block");
  const auto hit = motion.findImpact(body, 1, bodyIndex(scene, "ball"));
  ASSERT_TRUE(hit) << motion.message;
  const auto instant = findRest(motion, body);
  ASSERT_TRUE(instant);
  EXPECT_GT(timeOf(motion, *instant), motion.events[static_cast<std::size_t>(*hit)].time);
  EXPECT_TRUE(stateAt(motion, body, *instant).velocity.isZero(0));
  Edit edit(scene, contacts, 2);
  edit.vary(velocity("ball").only({"x"}));
  edit.nail("block", atRest()).position(0.9, any, any);
  const EditResult result = edit.solve();
  ASSERT_TRUE(result.solved()) << result.message;
  EXPECT_TRUE(std::abs(result.motion.stateAt("block", 2).position.x() - 0.9) <= 1e-9);
}

TEST(AtRest, ExtentAndHorizonReachToIt) {
  const Scene scene = sliding();
  OdeContacts contacts(scene);
  const ConstraintSet set(scene, {{"block", atRest(), {{"position", {1, any, any}}}}}, 4);
  EXPECT_TRUE(set.waits() && set.holdsAtRest());
  EXPECT_EQ(set.horizon(4), 4);
  EXPECT_EQ(set.leastDuration(), 0);
  const Motion motion = simulate(scene, contacts, 4);
  EXPECT_FALSE(set.hasWhatItWaitsFor(motion));
  const ConstraintSet::Extent extent = set.extentIn(motion);
  EXPECT_EQ(extent.events, motion.events.size());
  EXPECT_EQ(extent.time, motion.events.back().time);
}

/// What is held at rest in every scene of the derivatives.
std::vector<Constraint> everyRow(const std::string& body) {
  return {{body,
           atRest(),
           {{"position", {1, 0.2, any}},
            {"orientation", {1, 0, 0, 0}},
            {"time", {1}},
            {"point", {1, 1, 1}, {0.1, 0.2, 0.05}},
            {"height", {0.1}},
            {.quantity = "distance", .value = {0.3}, .to = "post"}}},
          {body, atRest(), {{"position", {1, 0, any}}}, "other"}};
}

struct Rest {
  const char* name;
  Scene scene;
  std::string body;
};
std::ostream& operator<<(std::ostream& out, const Rest& row) { return out << row.name; }

/// A post, and something that flies by, beside each.
Rest rest(const char* name, Body body) {
  const std::string of = body.name;
  Rest row{name, onFloor({std::move(body)}), of};
  Body post = ball("post", "wood", 0.1, {4, 3, 0.5}, Vec3::Zero());
  post.fixed = true;
  row.scene.bodies.push_back(post);
  row.scene.bodies.push_back(ball("other", "wood", 0.1, {-3, -4, 6}, {0.3, -0.2, 5}));
  return row;
}

std::vector<Rest> rests() {
  return {rest("slides", block("body", {0.1, 0, 0.05}, {1.2, 0.3, 0})),
          rest("falls", block("body", {0, 0, 0.5}, {2, 0.3, 0})),
          rest("bounces", ball("body", "wood", 0.1, {0.2, 0.1, 0.8}, Vec3::Zero()))};
}

class RowsAtRest : public testing::TestWithParam<Rest> {};

TEST_P(RowsAtRest, HaveTheirDerivatives) {
  const Rest& row = GetParam();
  OdeContacts contacts(row.scene);
  std::vector<Control> controls{position(row.body).only({"x", "y"}), mass(row.body), elasticity("wood"),
                                gravity().only({"z"}), velocity("other")};
  const bool slides = row.scene.bodies[1].velocity.norm() > 0;
  if (slides) controls.insert(controls.end(), {velocity(row.body).only({"x", "y"}), friction("wood")});
  const EditProblem problem(row.scene, contacts, 3, controls, everyRow(row.body));
  const Eigen::VectorXd values = problem.controls.startValues();
  const RowsAndJacobian a = evaluateByAdjoint(problem, values), t = evaluateByTangent(problem, values);
  ASSERT_TRUE(a.rows.available) << a.rows.message;
  EXPECT_TRUE(a.jacobian.allFinite());
  for (int j = 0; j < problem.controls.size(); ++j) {
    const double scale = t.jacobian.col(j).cwiseAbs().maxCoeff();
    const double h = 1e-5 * (1 + std::abs(values[j]));
    Eigen::VectorXd up = values, down = values;
    up[j] += h, down[j] -= h;
    const RowsAndJacobian above = evaluateByAdjoint(problem, up), below = evaluateByAdjoint(problem, down);
    for (int i = 0; i < problem.constraints.size(); ++i) {
      // by the mass, and of what slides all the while by the elasticity, all of them are 0
      EXPECT_TRUE(std::abs(a.jacobian(i, j) - t.jacobian(i, j)) <= 1e-13 * (1 + scale))
          << problem.constraints.describeRow(i) << " by " << problem.controls.describeVariable(j) << ": "
          << a.jacobian(i, j) << " and " << t.jacobian(i, j);
      const double difference = (above.rows.values[i] - below.rows.values[i]) / (2 * h);
      EXPECT_TRUE(std::abs(a.jacobian(i, j) - difference) <= 1e-6 * (1 + scale))
          << problem.constraints.describeRow(i) << " by " << problem.controls.describeVariable(j) << ": "
          << a.jacobian(i, j) << " and " << difference;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, RowsAtRest, testing::ValuesIn(rests()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(AtRest, TheCertificateKnowsWhenItWouldComeTooLate) {
  const Scene scene = sliding();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.7);
  edit.vary(velocity("block").only({"x"}));
  edit.nail("block", atRest()).position(0.4, any, any);
  const EditResult result = edit.solve();
  ASSERT_TRUE(result.solved()) << result.message;
  EXPECT_NE(result.certificate.signature_event.find("rest of 'block' begins after the end of the motion"),
            std::string::npos)
      << result.certificate.signature_event;
}

TEST(AtRest, AFunctionOfTheMotionIsReadUpToIt) {
  const Scene scene = sliding();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 4);
  edit.vary(velocity("block").only({"x", "y"}));
  MotionFunction place;
  place.name = "x";
  place.until = atRest(), place.body = "block";
  place.read = [](const Motion& motion) {
    const auto instant = findRest(motion, 1);
    RowReading reading;
    reading.value = stateAt(motion, 1, *instant).position.x();
    StateSeed seed;
    seed.body = 1, seed.at = *instant, seed.position = Vec3::UnitX();
    reading.seeds = {seed};
    reading.second_order = true;
    return reading;
  };
  edit.require(place, 1.1);
  edit.nail("block", atRest()).position(any, 0, any);
  const EditResult result = edit.solve();
  ASSERT_TRUE(result.solved()) << result.message;
  EXPECT_TRUE((velocityOf(result, "block") - throwOver({1, 0, 0})).norm() <= 1e-8)
      << velocityOf(result, "block").transpose();
}

}  // namespace
}  // namespace carom
