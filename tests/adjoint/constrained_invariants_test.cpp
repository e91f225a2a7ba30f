// SPDX-License-Identifier: MIT
// What holds of every body that contacts hold, whatever it does: contacts stay closed, energy does not grow, and neither
// the order of bodies nor the duration matters.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/compare.h"
#include "tests/support/constrained_checks.h"
#include "tests/support/constrained_scenes.h"
#include "tests/support/lasting_scenes.h"

namespace carom::held_invariants {
namespace {

using namespace test;

TEST(ConstrainedInvariants, ContactsStayClosedAndEnergyDoesNotGrow) {
  for (const ConstrainedCase& row : constrainedScenes()) {
    SCOPED_TRACE(row.name);
    const Motion m = playLasting(row.scene, row.duration);
    EXPECT_EQ(m.status, MotionStatus::complete) << m.message;
    const ConstrainedFindings found = lookAtConstrainedPaths(m, 100);
    EXPECT_GT(found.paths, 0);
    EXPECT_TRUE(found.worst_gap <= 1e-12) << found.worst_gap;
    EXPECT_TRUE(found.worst_growth <= 1e-12) << found.worst_growth;
  }
}

TEST(ConstrainedInvariants, TheOrderOfBodiesDoesNotMatter) {
  for (const ConstrainedCase& row : constrainedScenes()) {
    SCOPED_TRACE(row.name);
    Scene reversed = row.scene;
    std::ranges::reverse(reversed.bodies);
    const Motion m = playLasting(row.scene, row.duration), r = playLasting(reversed, row.duration);
    const int own = static_cast<int>(row.scene.bodies.size()) - 1;
    EXPECT_EQ(m.status, r.status) << m.message << "\n" << r.message;
    ASSERT_EQ(m.events.size(), r.events.size());
    for (std::size_t e = 0; e < m.events.size(); ++e) {
      EXPECT_EQ(m.events[e].kind, r.events[e].kind);
      EXPECT_EQ(m.events[e].cause, r.events[e].cause);
      expectEntries(r.events[e].time, m.events[e].time, 1e-9, "time of event " + std::to_string(e));
    }
    for (int i = 0; i <= 20; ++i) {
      const double t = std::min(m.end, r.end) * i / 20;
      expectEntries(flatten(r.stateAt(own, t)), flatten(m.stateAt(0, t)), 1e-8, "state at " + std::to_string(t), 10);
    }
  }
}

TEST(ConstrainedInvariants, TheSameBitsTwice) {
  for (const ConstrainedCase& row : constrainedScenes()) {
    SCOPED_TRACE(row.name);
    const Motion m = playLasting(row.scene, row.duration), again = playLasting(row.scene, row.duration);
    ASSERT_EQ(again.events.size(), m.events.size());
    for (std::size_t e = 0; e < m.events.size(); ++e) EXPECT_EQ(again.events[e].time, m.events[e].time);
    for (int i = 0; i <= 100; ++i) EXPECT_EQ(flatten(again.stateAt(0, m.end * i / 100)), flatten(m.stateAt(0, m.end * i / 100)));
  }
}

// The end of a motion also ends the intervals in which roots are looked for: the last digit may differ.
TEST(ConstrainedInvariants, HowLongItIsFollowedDoesNotMatter) {
  for (const ConstrainedCase& row : constrainedScenes()) {
    SCOPED_TRACE(row.name);
    const Motion m = playLasting(row.scene, row.duration), longer = playLasting(row.scene, row.duration + 60);
    ASSERT_GE(longer.events.size(), m.events.size());
    for (std::size_t e = 0; e < m.events.size(); ++e)
      expectEntries(longer.events[e].time, m.events[e].time, 1e-9, "time of event " + std::to_string(e));
    for (int i = 0; i <= 100; ++i)
      expectEntries(flatten(longer.stateAt(0, m.end * i / 100)), flatten(m.stateAt(0, m.end * i / 100)), 1e-9, "state", 10);
    if (m.world_lines[0].arcs.back().kind() == ArcKind::rest)
      expectEntries(flatten(longer.stateAt(0, row.duration + 60)), flatten(m.stateAt(0, row.duration)), 1e-11, "rest");
  }
}

}  // namespace
}  // namespace carom::held_invariants
