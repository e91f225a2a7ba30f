// SPDX-License-Identifier: MIT
// Whole edits, against closed forms where there are any.

#include "editing/edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/problem/jacobian.hpp"
#include "editing/problem_of.hpp"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;

TEST(Edit, HitsATargetOffFloorAndWall) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball").only({"x", "z"}));
  edit.nail("ball", 0.6).position({-2, any, 1.5});
  const EditResult r = edit.solve();
  ASSERT_EQ(r.status, EditStatus::solved) << r.message;
  expectHonest(r, 0.6, contacts);
  ASSERT_EQ(r.changed.size(), 2u);
  EXPECT_NEAR(r.changed[0].after, 10.195652173913, 1e-9);
  EXPECT_NEAR(r.changed[1].after, -4.0907100910675, 1e-9);
  EXPECT_EQ(r.changed[0].before, 5);
  EXPECT_EQ(r.scene.bodies[2].velocity.x(), r.changed[0].after);
  EXPECT_LE(r.residual, 1e-12);
  EXPECT_EQ(r.sequence_after.size(), 2u);
  RecordProperty("milliseconds", std::to_string(r.milliseconds));
}

TEST(Edit, ChangesTheSequenceOnlyWhenItMust) {
  const Scene scene = manyBounces();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 15);
  edit.vary(elasticity("rubber").within(0.8, 0.998));
  edit.nail("ball", 15.0).position({any, any, 20.1});
  const EditResult r = edit.solve();
  ASSERT_EQ(r.status, EditStatus::solved_sequence_changed) << r.message;
  expectHonest(r, 15, contacts);
  EXPECT_NEAR(r.changed[0].after, 0.9880083920248765, 1e-9);
  EXPECT_EQ(r.sequence_before.size(), 3u);
  EXPECT_EQ(r.sequence_after.size(), 2u);
  EXPECT_TRUE(r.signature_changed);

  EditOptions stay;
  stay.sequence = SequencePolicy::stay;
  const EditResult kept = edit.solve(stay);
  EXPECT_FALSE(kept.solved());
  EXPECT_FALSE(kept.signature_changed);
  expectHonest(kept, 15, contacts);
}

TEST(Edit, ThrowsABoxToAPose) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const Motion before = simulate(scene, contacts, 0.9);
  const BodyState state = before.stateAt("box", 0.9);
  Edit edit(scene, contacts, 1);
  edit.vary(velocity("box"), angularVelocity("box"), position("box"), elasticity("felt"), friction("felt"));
  const Vec3 target = state.position + Vec3(0.05, -0.03, 0.02);
  const Quat pose = Quat(Eigen::AngleAxisd(0.1, Vec3(1, 2, 3).normalized())) * state.orientation;
  edit.nail("box", 0.9).position(target).orientation(pose);
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  expectHonest(r, 1, contacts);
  const BodyState after = r.motion.stateAt("box", 0.9);
  EXPECT_LE((after.position - target).norm(), 1e-9);
  EXPECT_LE(after.orientation.angularDistance(pose), 1e-9);
  EXPECT_LE(r.scaled_residual, 1e-11);
  RecordProperty("milliseconds", std::to_string(r.milliseconds));
  RecordProperty("iterations", r.iterations);
}

// At the solution the change is in the row space of the Jacobian: no smaller change meets the rows to first order.
TEST(Edit, TheChangeIsTheSmallest) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const Vec3 target = simulate(scene, contacts, 0.9).stateAt("box", 0.45).position + Vec3(0.1, 0.05, -0.03);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box").weighted(2), angularVelocity("box"), mass("box"), elasticity("felt"));
  edit.nail("box", 0.45).position(target);
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  EXPECT_GT(r.objective, 1e-3);
  const auto problem = editing_detail::problemOf(edit);
  Eigen::VectorXd values(problem.controls.size()), changes(values.size());
  for (int i = 0; i < values.size(); ++i) {
    const editing_detail::Variable& v = problem.controls.variables()[i];
    values[i] = r.changed[i].after;
    changes[i] = v.logarithmic ? std::log(values[i] / v.start) / v.scale : (values[i] - v.start) / v.scale;
  }
  const Eigen::MatrixXd J =
      evaluateByAdjoint(problem, values).jacobian * problem.controls.valueRates(changes).asDiagonal();
  const Eigen::VectorXd along = J.transpose() * (J * J.transpose()).ldlt().solve(J * changes);
  EXPECT_LE((changes - along).norm(), 1e-5 * changes.norm()) << r.iterations;
}

TEST(Edit, ASatisfiedStartStaysAsItIs) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const BodyState state = simulate(scene, contacts, 0.9).stateAt("box", 0.9);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box"), mass("box"), tilt("box", 1));
  edit.nail("box", 0.9).position(state.position);
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::solved) << r.message;
  EXPECT_EQ(r.iterations, 0);
  EXPECT_EQ(r.objective, 0);
  EXPECT_TRUE(r.scene.bodies[1].density.has_value());
  EXPECT_TRUE(r.scene.tilts.empty());
}

TEST(Edit, NailsAtAnImpact) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const Motion before = simulate(scene, contacts, 1.5);
  const int event = before.findImpact(1, 2, 0).value();
  const Vec3 place = before.stateBefore(event, 1).position;
  Edit edit(scene, contacts, 1.5);
  edit.vary(velocity("box"), angularVelocity("box"));
  edit.nail("box", nthImpact(2, "floor"))
      .position({place.x() + 0.1, place.y(), any})
      .time(before.events[event].time + 0.02);
  const EditResult r = edit.solve();
  ASSERT_TRUE(r.solved()) << r.message;
  const int after = r.motion.findImpact(1, 2, 0).value();
  EXPECT_NEAR(r.motion.stateBefore(after, 1).position.x(), place.x() + 0.1, 1e-9);
  EXPECT_NEAR(r.motion.events[after].time, before.events[event].time + 0.02, 1e-9);
}

TEST(Edit, ContradictoryNailsAreNamed) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.5).position({0.5, any, 1});
  edit.nail("ball", 0.5).position({0.7, any, any});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::infeasible) << r.message;
  EXPECT_NE(r.message.find("position.x of 'ball' at 0.5 s"), std::string::npos) << r.message;
  expectHonest(r, 0.6, contacts);
}

TEST(Edit, RepeatedNailsDoNoHarm) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.6).position({-2, 0, 1.5});
  edit.nail("ball", 0.6).position({-2, 0, 1.5});
  const EditResult r = edit.solve();
  ASSERT_EQ(r.status, EditStatus::solved) << r.message;
  EXPECT_NEAR(r.changed[0].after, 10.195652173913, 1e-9);
  EXPECT_EQ(r.residuals.size(), 6u);
}

TEST(Edit, WhatNothingInfluencesIsNamed) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(elasticity("rubber"));
  edit.nail("ball", 0.1).position({any, any, 3});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::infeasible);
  EXPECT_NE(r.message.find("velocity.z of 'ball' is locked at -5 m/s, and it meets nothing before"), std::string::npos) << r.message;
}

TEST(Edit, MoreNailedThanCanVary) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(elasticity("rubber").within(0.5, 1));
  edit.nail("ball", 0.6).position({0, any, 1.4});
  const EditResult r = edit.solve();
  EXPECT_FALSE(r.solved());
  EXPECT_EQ(r.status, EditStatus::not_converged) << r.message;  // there is no proof
  expectHonest(r, 0.6, contacts);
}

TEST(Edit, NothingVaries) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.nail("ball", 0.6).position({0, any, 1.4});
  EXPECT_EQ(edit.solve().status, EditStatus::infeasible);
}

TEST(Edit, NothingConstrained) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::solved);
  EXPECT_EQ(r.iterations, 0);
}

TEST(Edit, ANailAfterTheEndIsABadStart) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball"));
  edit.nail("ball", 0.7).position({0, 0, 1});
  const EditResult r = edit.solve();
  EXPECT_EQ(r.status, EditStatus::bad_start);
  EXPECT_NE(r.message.find("after the end"), std::string::npos) << r.message;
  EXPECT_TRUE(std::isnan(r.scaled_residual));
}

TEST(Edit, AStartOutsideItsBoundsIsMovedAndSaid) {
  const Scene scene = manyBounces();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 15);
  edit.vary(elasticity("rubber").within(0.96, 0.998));
  edit.nail("ball", 15.0).position({any, any, 20.1});
  const EditResult r = edit.solve();
  ASSERT_EQ(r.status, EditStatus::solved_sequence_changed) << r.message;
  EXPECT_EQ(r.changed[0].before, 0.8);
  EXPECT_NEAR(r.changed[0].after, 0.9880083920248765, 1e-9);
  EXPECT_NE(r.message.find("outside its bounds"), std::string::npos) << r.message;
}

TEST(Edit, BoundsAreKept) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  edit.vary(velocity("ball").only({"x", "z"}).within(-6, 6));
  edit.nail("ball", 0.6).position({-2, any, 1.5});
  EditOptions options;
  options.sequence = SequencePolicy::stay;
  const EditResult r = edit.solve(options);
  EXPECT_EQ(r.status, EditStatus::not_converged) << r.message;
  for (const ChangedNumber& number : r.changed) {
    EXPECT_LE(number.after, 6);
    EXPECT_GE(number.after, -6);
  }
  expectHonest(r, 0.6, contacts);
}

TEST(Edit, NailsHoldUntilRemoved) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.6);
  Nail nail = edit.nail("ball", 0.5);
  nail.position({0, 0, 1}).position({0, 0, 2}).point({0.1, 0, 0}, {0, 0, 3}).point({-0.1, 0, 0}, {0, 0, 3});
  ASSERT_EQ(edit.constraints().size(), 1u);
  EXPECT_EQ(edit.constraints()[0].targets.size(), 3u);
  EXPECT_EQ(edit.constraints()[0].targets[0].value[2], 2);
  edit.unnail(nail);
  EXPECT_TRUE(edit.constraints().empty());
  EXPECT_THROW(nail.position({0, 0, 0}), InputError);
}

TEST(Edit, TheSameEditTwiceIsTheSameToTheBit) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  Edit edit(scene, contacts, 0.9);
  edit.vary(velocity("box"), angularVelocity("box"));
  edit.nail("box", 0.9).position({1.4, 0.3, 0.4});
  const EditResult a = edit.solve(), b = edit.solve();
  ASSERT_EQ(a.changed.size(), b.changed.size());
  for (std::size_t i = 0; i < a.changed.size(); ++i) EXPECT_EQ(a.changed[i].after, b.changed[i].after);
}

TEST(Edit, TwoThreads) {
  const Scene scene = thrownBox();
  EditResult results[2];
  const auto work = [&](EditResult& result) {
    OdeContacts contacts(scene);
    for (int i = 0; i < 5; ++i) {
      Edit edit(scene, contacts, 0.9);
      edit.vary(velocity("box"), angularVelocity("box"));
      edit.nail("box", 0.9).position({1.4, 0.3, 0.4});
      result = edit.solve();
    }
  };
  std::thread other(work, std::ref(results[1]));
  work(results[0]);
  other.join();
  ASSERT_EQ(results[0].status, results[1].status);
  for (std::size_t i = 0; i < results[0].changed.size(); ++i) {
    EXPECT_EQ(results[0].changed[i].after, results[1].changed[i].after);
  }
}

}  // namespace
}  // namespace carom
