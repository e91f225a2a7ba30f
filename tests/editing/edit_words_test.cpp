// SPDX-License-Identifier: MIT
// Messages of edits: on impacts that did not change, required impacts, and near misses.
#include <gtest/gtest.h>

#include <algorithm>

#include "editing/edit.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

/// A ball thrown beside another one, which falls to the floor before they can meet.
Scene throwBeside(double side) {
  Body floor = test::makeBall("floor", 1, Vec3::Zero());
  floor.shape = Plane{};
  return test::makeScene({0, 0, -9.81}, 0.5, 0.3,
                         {test::fixedBody(floor), test::makeBall("thrown", 0.1, {-1, side, 1}, {2, 0, 1}),
                          test::makeBall("target", 0.1, {0.2, 0, 0.3})});
}

EditResult solvedHit(const Scene& scene, const std::vector<Control>& controls) {
  Constraint hit{"thrown", 0.0, {}};
  hit.hits = Hit{"target"};
  OdeContacts contacts(scene);
  return Edit(scene, contacts, 1.2, controls, {hit}).solve();
}

TEST(EditWords, AnImpactThatDidNotChangeHasNotPassedTheLastConstraint) {
  const EditResult r = solvedHit(throwBeside(0.4), {velocity("thrown")});
  ASSERT_TRUE(r.solved()) << r.message;
  for (const SequenceChange& change : r.sequence_changes)
    EXPECT_NE(change.kind, SequenceChange::Kind::passed) << change.sentence;
  EXPECT_EQ(r.message.find("last constraint"), std::string::npos) << r.message;
}

TEST(EditWords, ARequiredImpactHasItsTime) {
  const EditResult r = solvedHit(throwBeside(0.4), {velocity("thrown")});
  ASSERT_EQ(r.times.size(), 1u);
  EXPECT_EQ(r.times[0].name, "'thrown' hits 'target'");
  const auto meets = [](const Event& e) { return e.counts() && e.meets(1, 2); };
  const auto first = std::find_if(r.motion.events.begin(), r.motion.events.end(), meets);
  ASSERT_NE(first, r.motion.events.end());
  EXPECT_EQ(r.times[0].time, first->time);
}

TEST(EditWords, WhatIsLockedIsNamed) {
  const EditResult proven = solvedHit(throwBeside(1.4), {velocity("thrown").only({"x", "z"})});
  EXPECT_EQ(proven.status, EditStatus::infeasible);
  EXPECT_NE(proven.message.find("Velocity.y of 'thrown' is locked at 0 m/s"), std::string::npos) << proven.message;
  Scene spinning = throwBeside(1.4);  // friction may lead it aside
  for (Body& body : spinning.bodies)
    if (body.name == "thrown") body.angular_velocity.x() = 0.1;
  const EditResult r = solvedHit(spinning, {velocity("thrown").only({"x", "z"})});
  EXPECT_EQ(r.status, EditStatus::not_converged);
  EXPECT_NE(r.message.find(", which does not vary, would bring them nearer."), std::string::npos) << r.message;
}

}  // namespace
}  // namespace carom
