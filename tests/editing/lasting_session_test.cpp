// SPDX-License-Identifier: MIT
// Sessions in which what is grabbed slides, rolls or rests: drags, nails, undo, and the journal played again.

#include <gtest/gtest.h>

#include "adjoint/simulate/simulate.h"
#include "editing/session_replay.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/session_scenes.h"
#include "tests/support/scenes.h"

namespace carom {
namespace {

using namespace test;
using namespace testing_sessions;

struct Drag {
  const char* name;
  Body body;
  double nailed, grabbed;  ///< s
  Vec3 by;                 ///< m
};

std::vector<Drag> drags() {
  const Body stone = makeBox("stone", {0.4, 0.3, 0.2}, {0, 0, 0.1}, {1.5, 0.2, 0});
  Body ball = makeBall("ball", 0.1, {0, 0, 0.5}, {1, 0.1, 0});
  return {{"a stone at rest", stone, 0, 4, {-0.3, 0.25, 0}},
          {"a stone that slides", stone, 0, 0.5, {0.1, 0.2, 0}},
          {"a ball that rolls", ball, 0, 3, {0.4, -0.3, 0}},
          {"a ball that rolls, held where it lands", ball, 0.2, 2, {0.2, 0.1, 0}}};
}

TEST(LastingSession, DragsAndNailsHoldAndPlayAgain) {
  for (Drag& drag : drags()) {
    SCOPED_TRACE(drag.name);
    const std::string name = drag.body.name;
    const Scene scene = makeScene({0, 0, -9.81}, 0.3, 0.15, {drag.body, makePlane("floor", Vec3::UnitZ(), 0)});
    OdeContacts contacts(scene);
    EditSession session(scene, contacts, 4, withoutClock());
    session.setControls({velocity(name), position(name)});
    const Vec3 held = session.motion().stateAt(name, drag.nailed).position;
    session.nail(name, drag.nailed, {.position = held});
    ASSERT_EQ(session.motion().status, MotionStatus::complete) << session.motion().message;
    session.grab(name, drag.grabbed);
    const Vec3 from = session.grabbedPlace(), to = from + drag.by;
    for (int k = 1; k <= 5; ++k) session.dragTo(from + 0.2 * k * drag.by);
    const SessionUpdate update = session.release();
    EXPECT_TRUE(update.reached) << update.message;
    const Motion again = simulate(session.scene(), contacts, 4);
    EXPECT_EQ(again.signature(), session.motion().signature());
    EXPECT_TRUE((again.stateAt(name, drag.grabbed).position - to).norm() <= 1e-9)
        << again.stateAt(name, drag.grabbed).position;
    EXPECT_TRUE((again.stateAt(name, drag.nailed).position - held).norm() <= 1e-9);

    SessionReplay replay(session.journal(), contacts);
    while (!replay.done()) {
      const ReplayedGesture played = replay.next();
      EXPECT_TRUE(played.differences.empty()) << played.differences.front();
    }
    session.undo();
    EXPECT_TRUE(session.motion().stateAt(name, drag.grabbed).position == from);
  }
}

}  // namespace
}  // namespace carom
