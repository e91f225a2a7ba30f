// SPDX-License-Identifier: MIT
// Rows of constraints, and the Jacobian of all of them by every kind of control, by adjoint and by tangent.

#include "editing/problem/rows/constraint_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "adjoint/base/errors.h"
#include "adjoint/numeric/so3.hpp"
#include "adjoint/simulate/simulate.h"
#include "editing/problem/jacobian.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {

using namespace adjoint_detail;
using namespace editing_detail;

namespace {

using namespace testing_scenes;

TEST(ConstraintSet, EveryQuantityIsTested) {
  for (const QuantityKind* kind : quantityKinds()) {
    bool found = false;
    for (const Constraint& constraint : everyQuantity()) {
      for (const Target& target : constraint.targets) found = found || target.quantity == kind->word;
    }
    EXPECT_TRUE(found) << kind->word;
  }
}

TEST(ConstraintSet, NamesItsRows) {
  const ConstraintSet set(thrownBox(), everyQuantity());
  const char* expected[] = {"position.x",    "position.z", "orientation.x", "orientation.y",
                            "orientation.z", "velocity.x", "velocity.y",    "time",
                            "point.x",       "point.y",    "point.z",       "angular_velocity.y",
                            "speed",         "kinetic_energy", "height",    "distance to 'floor'",
                            "closest_approach to 'floor'", "impulse", "speed", "kinetic_energy",
                            "contact.x", "contact.y"};
  ASSERT_EQ(set.size(), 22);
  for (int i = 0; i < 22; ++i) EXPECT_EQ(set.rows()[i].name, expected[i]);
  EXPECT_EQ(set.describeRow(0), "position.x of 'box' at 0.4 s");
  EXPECT_EQ(set.describeRow(15), "distance to 'floor' of 'box' at 0.4 s");
  EXPECT_EQ(set.describeRow(16), "closest_approach to 'floor' of 'box' from 0.05 s to 0.3 s");
  EXPECT_EQ(set.describeRow(7), "time of 'box' at its impact 2 with 'floor'");
}

TEST(ConstraintSet, ReadsTheMotion) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 1);
  const ConstraintSet set(scene, everyQuantity());
  const RowValues rows = set.evaluate(motion);
  ASSERT_TRUE(rows.available) << rows.message;
  const BodyState at = motion.stateAt("box", 0.4);
  const int event = motion.findImpact(1, 2, 0).value();
  const BodyState before = motion.stateBefore(event, 1);
  EXPECT_EQ(rows.values[0], at.position.x());
  EXPECT_EQ(rows.residuals[1], at.position.z() - 2);
  EXPECT_LE((Vec3(rows.values.segment<3>(2)) - logSO3(at.orientation)).norm(), 1e-15);
  EXPECT_EQ(rows.values[7], motion.events[event].time);
  const Vec3 point = before.position + before.orientation.toRotationMatrix() * Vec3(0.1, 0.2, 0.3);
  EXPECT_LE((Vec3(rows.values.segment<3>(8)) - point).norm(), 1e-15);
  EXPECT_EQ(rows.values[11], before.angular_velocity.y());
  EXPECT_EQ(rows.scaled[0], rows.residuals[0] / set.rows()[0].scale);
}

TEST(ConstraintSet, WhatTheMotionDoesNotHaveIsSaid) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const Motion motion = simulate(scene, contacts, 0.3);
  const RowValues late = ConstraintSet(scene, {{"box", 0.4, {{"position", {0, 0, 0}}}}}).evaluate(motion);
  EXPECT_FALSE(late.available);
  EXPECT_NE(late.message.find("'box' at 0.4 s lies after the end of the motion at 0.3 s"), std::string::npos)
      << late.message;
  EXPECT_TRUE(std::isnan(late.residuals[0]));
  EXPECT_TRUE(late.seeds[0].empty());
  const RowValues never = ConstraintSet(scene, {{"box", nthImpact(9, "floor"), {{"time", {1}}}}}).evaluate(motion);
  EXPECT_FALSE(never.available);
  EXPECT_NE(never.message.find("Impact 9 with 'floor' of 'box' does not come within 0.3 s"), std::string::npos)
      << never.message;
}

TEST(Jacobian, AdjointAndTangentAgreeEntryByEntry) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 1, everyControl(), everyQuantity());
  // Away from the start too, where an orientation's value is not its derivative's base.
  for (double away : {0.0, 0.02}) {
    const Eigen::VectorXd values =
        problem.controls.valuesOf(Eigen::VectorXd::LinSpaced(problem.controls.size(), -away, away));
    const RowsAndJacobian a = evaluateByAdjoint(problem, values), t = evaluateByTangent(problem, values);
    ASSERT_TRUE(a.rows.available) << a.rows.message;
    ASSERT_EQ(a.jacobian.rows(), 22);
    ASSERT_EQ(a.jacobian.cols(), problem.controls.size());
    for (int j = 0; j < a.jacobian.cols(); ++j) {
      const double scale = t.jacobian.col(j).cwiseAbs().maxCoeff();
      for (int i = 0; i < a.jacobian.rows(); ++i) {
        EXPECT_TRUE(std::abs(a.jacobian(i, j) - t.jacobian(i, j)) <= 1e-12 * scale)
            << problem.constraints.describeRow(i) << " by " << problem.controls.describeVariable(j);
      }
    }
  }
}

TEST(Jacobian, AgreesWithDifferences) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const EditProblem problem(scene, contacts, 0.6, everyControl(), everyQuantity());
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(problem.controls.size(), -0.01, 0.015);
  const Eigen::VectorXd values = problem.controls.valuesOf(at);
  const RowsAndJacobian exact = evaluateByAdjoint(problem, values);
  const Eigen::VectorXd rates = problem.controls.valueRates(at);
  for (int j = 0; j < problem.controls.size(); ++j) {
    const double h = 1e-6;
    Eigen::VectorXd up = at, down = at;
    up[j] += h, down[j] -= h;
    const RowsAndJacobian a = evaluateByAdjoint(problem, problem.controls.valuesOf(up));
    const RowsAndJacobian b = evaluateByAdjoint(problem, problem.controls.valuesOf(down));
    ASSERT_EQ(a.motion.signature(), b.motion.signature());
    const Eigen::VectorXd column = exact.jacobian.col(j) * rates[j];
    const double scale = 1 + column.cwiseAbs().maxCoeff();
    for (int i = 0; i < exact.jacobian.rows(); ++i) {
      const double difference = (a.rows.values[i] - b.rows.values[i]) / (2 * h);
      EXPECT_TRUE(std::abs(column[i] - difference) <= 1e-6 * scale)
          << problem.constraints.describeRow(i) << " by " << problem.controls.describeVariable(j) << ": " << column[i]
          << " and " << difference;
    }
  }
}

// Simulating with no more detail than a problem asks for gives the same rows and derivatives.
TEST(Jacobian, LessDetailGivesTheSame) {
  Scene scene = thrownBox();
  scene.bodies.push_back(ball("ball", "felt", 0.1, {1, 1, 1}, {0.5, 0, 0}));
  OdeContacts contacts(scene);
  const std::vector<Control> controls{velocity("ball"), angularVelocity("ball"), mass("box"), velocity("box")};
  const std::vector<Constraint> constraints{{"ball", 0.8, {{"position", {0, 0, 0}}}},
                                            {"box", 0.5, {{"position", {0, 0, 0}}, {"velocity", {0, 0, 0}}}}};
  EditProblem problem(scene, contacts, 1, controls, constraints);
  const Eigen::VectorXd values = problem.controls.startValues();
  const RowsAndJacobian little = evaluateByAdjoint(problem, values);
  problem.asked.clear();
  const RowsAndJacobian all = evaluateByAdjoint(problem, values);
  EXPECT_EQ(little.motion.signature(), all.motion.signature());
  for (int i = 0; i < problem.constraints.size(); ++i) {
    EXPECT_NEAR(little.rows.values[i], all.rows.values[i], 1e-12);
    for (int j = 0; j < problem.controls.size(); ++j) {
      EXPECT_NEAR(little.jacobian(i, j), all.jacobian(i, j), 1e-11 * (1 + std::abs(all.jacobian(i, j))));
    }
  }
}

struct BadConstraint {
  const char* name;
  Constraint constraint;
  const char* where;
  const char* says;
};

When restAnd(void (*change)(When&)) {
  When at = atRest();
  change(at);
  return at;
}

When wrongImpact() {
  When at = nthImpact(1);
  at.impact = -1;
  return at;
}

const BadConstraint kBadConstraints[] = {
    {"body", {"bix", 0.4, {{"position", {0, 0, 0}}}}, "/constraints/0/body", "bix"},
    {"with", {"box", nthImpact(1, "wall"), {{"position", {0, 0, 0}}}}, "/constraints/0/at/with", "wall"},
    {"word", {"box", 0.4, {{"place", {0, 0, 0}}}}, "/constraints/0", "expected one of position"},
    {"count", {"box", 0.4, {{"position", {0, 0}}}}, "/constraints/0/position", "expected 3"},
    {"infinite", {"box", 0.4, {{"position", {0, 0, INFINITY}}}}, "/constraints/0/position", "infinite"},
    {"quaternion", {"box", 0.4, {{"orientation", {2, 0, 0, 0}}}}, "/constraints/0/orientation", "expected 1"},
    {"nan_quaternion", {"box", 0.4, {{"orientation", {1, kNaN, 0, 0}}}}, "/constraints/0/orientation", "NaN"},
    {"nan_position", {"box", 0.4, {{"position", {kNaN, 0, any}}}}, "/constraints/0/position", "NaN"},
    {"nan_min", {"box", 0.4, {{"position", {any, 0, any}, {}, {kNaN, any, any}}}}, "/constraints/0/position/min", "NaN"},
    {"free_time", {"box", nthImpact(1), {{"time", {any}}}}, "/constraints/0/time", "free"},
    {"nan_time", {"box", nthImpact(1), {{"time", {kNaN}}}}, "/constraints/0/time", "NaN"},
    {"time_at_time", {"box", 0.4, {{"time", {0.4}}}}, "/constraints/0/time", "expected an impact"},
    {"at", {"box", kNaN, {{"position", {0, 0, 0}}}}, "/constraints/0/at", "expected a time"},
    {"negative", {"box", -1.0, {{"position", {0, 0, 0}}}}, "/constraints/0/at", "expected a time"},
    {"impact", {"box", wrongImpact(), {{"position", {0, 0, 0}}}}, "/constraints/0/at/impact", "1 or more"},
    {"impulse_at_time", {"box", 0.4, {{"impulse", {1}}}}, "/constraints/0/impulse", "expected an impact"},
    {"no_speed", {"box", 0.4, {{"speed", {0}}}}, "/constraints/0/speed", "expected more than 0 m/s; what is at rest"},
    {"negative_energy", {"box", 0.4, {{"kinetic_energy", {-1}}}}, "/constraints/0/kinetic_energy", "more than 0 J"},
    {"max_impulse",
     {"box", nthImpact(1), {{"impulse", {any}, {}, {}, {0}}}},
     "/constraints/0/impulse/max",
     "found 0, expected more than 0 N s"},
    {"free_height", {"box", 0.4, {{"height", {any}}}}, "/constraints/0/height", "cannot be left free"},
    {"two_heights", {"box", 0.4, {{"height", {1, 2}}}}, "/constraints/0/height", "found 2 numbers, expected 1"},
    {"place_of_floor", {"floor", 0.4, {{"position", {0, any, any}}}}, "/constraints/0/body", "found the fixed body 'floor'"},
    {"impact_of_floor", {"floor", nthImpact(1), {{"time", {0.3}}}}, "/constraints/0/body", "an impact of the fixed body"},
    {"energy_of_floor", {"floor", 0.4, {{"kinetic_energy", {1}}}}, "/constraints/0/body", "found the fixed body 'floor'"},
    {"height_of_floor", {"floor", 0.4, {{"height", {1}}}}, "/constraints/0/body", "with a lowest point"},
    {"energy_seen", {"box", 0.4, {{"kinetic_energy", {1}}}, "floor"}, "/constraints/0/relative_to", "in the world"},
    {"height_seen", {"box", 0.4, {{"height", {1}}}, "floor"}, "/constraints/0/relative_to", "in the world"},
    {"impulse_seen", {"box", nthImpact(1), {{"impulse", {1}}}, "floor"}, "/constraints/0/relative_to", "in the world"},
    {"rest_of_floor",
     {"floor", atRest(), {{"position", {0, 0, 0}}}},
     "/constraints/0/body",
     "others never come to rest"},
    {"velocity_at_rest",
     {"box", atRest(), {{"velocity", {0, 0, 0}}}},
     "/constraints/0/velocity",
     "found velocity held at rest, expected a time or an impact"},
    {"speed_at_rest", {"box", atRest(), {{"speed", {1}}}}, "/constraints/0/speed", "a body at rest has none"},
    {"contact_at_time", {"box", 0.4, {{"contact", {1, 1, any}}}}, "/constraints/0/contact", "expected an impact"},
    {"contact_at_rest", {"box", atRest(), {{"contact", {1, 1, any}}}}, "/constraints/0/contact", "at rest, expected an impact"},
    {"contact_seen", {"box", nthImpact(1), {{"contact", {1, 1, any}}}, "floor"}, "/constraints/0/relative_to", "in the world"},
    {"impulse_at_rest", {"box", atRest(), {{"impulse", {1}}}}, "/constraints/0/impulse", "at rest, expected an impact"},
    {"rest_and_impact",
     {"box", restAnd([](When& at) { at.impact = 1; }), {{"position", {0, 0, 0}}}},
     "/constraints/0/at",
     "found rest and an impact, expected one of the two"},
    {"rest_and_span",
     {"box", restAnd([](When& at) { at.span = {0, 1}; }), {{"position", {0, 0, 0}}}},
     "/constraints/0/at",
     "found rest and a span of time"},
    {"rest_and_time",
     {"box", restAnd([](When& at) { at.time = 1; }), {{"position", {0, 0, 0}}}},
     "/constraints/0/at",
     "found rest and a time"},
    {"all_free", {"box", 0.4, {{"position", {any, any, any}}}}, "/constraints/0", "no target"},
    {"nothing", {"box", 0.4, {}}, "/constraints/0", "no target"},
};

class ConstraintMistake : public testing::TestWithParam<BadConstraint> {};

TEST_P(ConstraintMistake, IsNamed) {
  try {
    const ConstraintSet set(thrownBox(), {GetParam().constraint});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), GetParam().where);
    EXPECT_NE(error.message().find(GetParam().says), std::string::npos) << error.message();
  }
}

INSTANTIATE_TEST_SUITE_P(Table, ConstraintMistake, testing::ValuesIn(kBadConstraints),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(EditProblem, DurationMustBePositive) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  for (double duration : {0.0, -1.0, kNaN, static_cast<double>(INFINITY)}) {
    EXPECT_THROW(EditProblem(scene, contacts, duration, {}, {}), InputError) << duration;
  }
}

}  // namespace
}  // namespace carom
