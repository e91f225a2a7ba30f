// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "editing/session_replay.h"
#include "tests/editing/session_scenes.h"
#include "tests/editing/stopping_contacts.h"

namespace carom::testing_sessions {

/// A session whose motions are counted.
struct StoppedSession {
  Scene scene;
  OdeContacts inner;
  StopAfter stop;
  StoppingContacts contacts{inner, stop};
  EditSession session;

  explicit StoppedSession(Scene written, double duration, std::vector<Control> controls)
      : scene(std::move(written)),
        inner(scene),
        session(scene, contacts, duration, std::move(controls), {}, withoutClock()) {}
};

/// Plays the journal of a session again, which comes to the same bits.
inline void expectSameAgain(const StoppedSession& s) {
  OdeContacts contacts(s.scene);
  SessionReplay replay(s.session.journal(), contacts);
  while (!replay.done()) {
    const ReplayedGesture gesture = replay.next();
    EXPECT_TRUE(gesture.differences.empty()) << gesture.differences[0];
  }
  EXPECT_TRUE(sameScene(replay.session().scene(), s.session.scene()));
  EXPECT_EQ(replay.session().nails().size(), s.session.nails().size());
}

}  // namespace carom::testing_sessions
