// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "editing/session.h"
#include "editing/session_replay.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/editing/scenes.h"

/// Sessions that several tests use. None of them has a clock: what they do is the same on every machine.
namespace carom::testing_sessions {

inline SessionOptions withoutClock() {
  SessionOptions options;
  options.release_iterations = 40;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  return options;
}

struct BoxSession {
  Scene scene = testing_scenes::thrownBox();
  OdeContacts contacts{scene};
  EditSession session;

  explicit BoxSession(const SessionOptions& options = withoutClock()) : session(scene, contacts, 1.2, options) {
    session.vary(velocity("box"), angularVelocity("box"), elasticity("felt"));
  }
};

inline bool sameBits(const Vec3& a, const Vec3& b) { return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0; }

/// The same numbers to the last bit in everything that a session of these tests may change.
inline bool sameScene(const Scene& a, const Scene& b) {
  if (a.bodies.size() != b.bodies.size() || a.materials.size() != b.materials.size()) return false;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const Body &x = a.bodies[i], &y = b.bodies[i];
    if (!sameBits(x.position, y.position) || !sameBits(x.velocity, y.velocity) ||
        !sameBits(x.angular_velocity, y.angular_velocity) || x.orientation.coeffs() != y.orientation.coeffs() ||
        x.mass != y.mass || x.density != y.density)
      return false;
  }
  for (std::size_t i = 0; i < a.materials.size(); ++i)
    if (a.materials[i].elasticity != b.materials[i].elasticity || a.materials[i].friction != b.materials[i].friction)
      return false;
  return true;
}

/// What the journal of a session plays is the session: its scene, its duration, and its nails and how they are.
inline void expectSameAgain(const EditSession& session, const Scene& scene) {
  OdeContacts contacts(scene);
  SessionReplay replay(session.journal(), contacts);
  while (!replay.done()) {
    const ReplayedGesture gesture = replay.next();
    EXPECT_TRUE(gesture.differences.empty()) << gesture.differences[0];
  }
  EXPECT_TRUE(sameScene(replay.session().scene(), session.scene()));
  EXPECT_EQ(replay.session().duration(), session.duration());
  ASSERT_EQ(replay.session().nails(), session.nails());
  const std::vector<NailState> here = session.nailStates(), there = replay.session().nailStates();
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_EQ(here[i].on, there[i].on) << i;
    EXPECT_EQ(here[i].met, there[i].met) << i;
  }
}

}  // namespace carom::testing_sessions
