// SPDX-License-Identifier: MIT
// Replays of bodies that move on each other: in the same scene to the bit, beside it as the motion there.

#include <gtest/gtest.h>

#include "adjoint/simulate/simulate_along.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/support/compare.h"
#include "tests/support/group_scenes.h"
#include "tests/support/scenes.h"

namespace carom::group_replays {
namespace {

using namespace test;
using namespace groups;

MotionAlong replay(const Motion& like, const Scene& scene, double until) {
  OdeContacts contacts(scene);
  contacts.begin(scene);
  return simulateAlong(like, scene, contacts.geometry(), until);
}

TEST(GroupReplays, AreTheSameMotions) {
  for (const GroupCase& c : groupCases()) {
    SCOPED_TRACE(c.name);
    const Motion m = playGroups(c.scene, c.until);
    ASSERT_EQ(m.status, MotionStatus::complete) << m.message;
    const MotionAlong same = replay(m, c.scene, c.until);
    ASSERT_TRUE(same.complete) << same.why_not;
    ASSERT_EQ(same.motion.events.size(), m.events.size());
    for (std::size_t b = 0; b < c.scene.bodies.size(); ++b)
      for (const double t : {0.3 * c.until, 0.7 * c.until, c.until}) {
        EXPECT_EQ(same.motion.stateAt(static_cast<int>(b), t).position, m.stateAt(static_cast<int>(b), t).position) << "body " << b << " at " << t;
        EXPECT_EQ(same.motion.stateAt(static_cast<int>(b), t).velocity, m.stateAt(static_cast<int>(b), t).velocity) << "body " << b << " at " << t;
      }
    Random random(11);
    SceneTangent d = randomDirection(c.scene, random);
    if (c.along) c.along(d);
    for (MaterialDerivative& of : d.materials) of.elasticity = of.tangential_elasticity = 0;
    d.materials[1].friction = 0;
    const Scene beside = moved(c.scene, d, 1e-4);
    const Motion there = playGroups(beside, c.until);
    if (there.status != MotionStatus::complete || there.events.size() != m.events.size()) continue;
    const MotionAlong along = replay(m, beside, c.until);
    ASSERT_TRUE(along.complete) << along.why_not;
    for (std::size_t b = 1; b < c.scene.bodies.size(); ++b) {
      const BodyState found = along.motion.stateAt(static_cast<int>(b), c.until), expected = there.stateAt(static_cast<int>(b), c.until);
      expectEntries(found.position, expected.position, 1e-11, "position");
      expectEntries(found.velocity, expected.velocity, 1e-11, "velocity");
      expectEntries(found.angular_velocity, expected.angular_velocity, 1e-10, "angular velocity");
    }
  }
}

}  // namespace
}  // namespace carom::group_replays
