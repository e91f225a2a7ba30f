// SPDX-License-Identifier: MIT
// Sessions that are stopped at any moment, and hands that rest: what is kept, and that it plays again to the same bits.
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "adjoint/base/errors.h"
#include "adjoint/simulate/simulate.h"
#include "editing/session_replay.h"
#include "editing/solve/budget.hpp"
#include "tests/editing/stopped_session.h"

namespace carom {

using namespace editing_detail;

namespace {

using namespace testing_scenes;
using namespace testing_sessions;

/// Drags, rests, releases and nails, each stopped after a random number of motions; how many were stopped.
int playAndStop(StoppedSession& s, const std::string& body, double t, const Vec3& by, unsigned seed) {
  std::mt19937 random(seed);
  EditSession& session = s.session;
  int stopped = 0;
  const auto soon = [&](int most) { return s.stop.set(static_cast<int>(random() % static_cast<unsigned>(most))); };
  const auto note = [&] {
    const SessionUpdate& u = session.last();
    EXPECT_FALSE(u.cut_by_clock);
    EXPECT_EQ(simulate(u.scene(), s.inner, session.duration()).signature(), u.motion->signature());
    if (!u.stopped) return;
    ++stopped;
    if (!u.reached) {
      EXPECT_NE(u.obstacle.kind, SessionObstacle::Kind::none) << u.message;
      EXPECT_NE(u.obstacle.kind, SessionObstacle::Kind::clock) << u.message;
    }
  };
  for (int gesture = 0; gesture < 3; ++gesture) {
    session.grab(body, t);
    const Vec3 start = session.grabbedPlace();
    for (int k = 1; k <= 3; ++k) session.dragTo(start + by * k / 3 * (gesture == 1 ? -0.3 : 1), soon(6)), note();
    session.dwell(soon(30)), note();
    session.release(soon(150)), note();
  }
  const NailId nail = session.nail(
      nailConstraint(body, t, {.position = session.motion().stateAt(body, t).position + 0.3 * by}), soon(40));
  note();
  session.setNail(nail, nailConstraint(body, 0.9 * t, {.position = session.motion().stateAt(body, t).position}),
                  soon(40));
  note();
  session.meetNails(soon(40)), note();
  return stopped;
}

TEST(SessionStop, WhatWasStoppedPlaysToTheSameBits) {
  int stopped = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    StoppedSession wall(floorAndWall(), 0.6, {velocity("ball").only({"x", "z"})});
    stopped += playAndStop(wall, "ball", 0.6, {0.9, 0, 0.1}, seed);
    expectSameAgain(wall);
    StoppedSession box(thrownBox(), 1.2, {velocity("box"), angularVelocity("box"), elasticity("felt")});
    stopped += playAndStop(box, "box", 0.9, {0.4, 0.2, 0.3}, seed);
    expectSameAgain(box);
  }
  EXPECT_GE(stopped, 30) << "of 240 calls";
}

TEST(SessionStop, AStopBeforeTheCallKeepsWhatThereIs) {
  BoxSession s;
  std::stop_source source;
  source.request_stop();
  s.session.grab("box", 0.6);
  const Vec3 start = s.session.grabbedPlace();
  const SessionUpdate u = s.session.dragTo(start + Vec3(0.05, 0, 0), source.get_token());
  EXPECT_TRUE(u.stopped);
  EXPECT_FALSE(u.moved);
  EXPECT_EQ(u.stage, SessionStage::kept);
  EXPECT_TRUE(std::abs(u.distance - 0.05) <= 1e-12) << u.distance;
  EXPECT_EQ(s.session.dwell(source.get_token()).simulations, 0);
  EXPECT_TRUE(s.session.release(source.get_token()).stopped);
  EXPECT_TRUE(sameScene(s.session.scene(), s.scene));
  EXPECT_EQ(s.session.journal().gestures.back().cut_after, 0);
}

TEST(SessionStop, AHandThatRestsComesToItsTarget) {
  SessionOptions options = withoutClock();
  options.drag_simulations = 1;
  BoxSession s(options);
  s.session.grab("box", 0.6);
  const Vec3 target = s.session.grabbedPlace() + Vec3(0.2, 0.1, 0.1);
  const SessionUpdate first = s.session.dragTo(target);
  ASSERT_FALSE(first.reached);
  std::vector<SessionUpdate> shown;
  const SessionUpdate u = s.session.dwell({}, [&](const SessionUpdate& better) { shown.push_back(better); });
  EXPECT_TRUE(u.reached) << u.message;
  EXPECT_TRUE(u.moved);
  EXPECT_GT(u.simulations, 1);
  EXPECT_LE(u.simulations, options.dwell_simulations);
  ASSERT_GE(shown.size(), 2u);
  double before = first.distance;
  for (const SessionUpdate& better : shown) {
    EXPECT_EQ(better.motion->duration, 1.2);
    EXPECT_EQ(simulate(better.scene(), s.contacts, 1.2).signature(), better.motion->signature());
    const double away = (better.motion->stateAt("box", 0.6).position - target).norm();
    EXPECT_TRUE(std::abs(away - better.distance) <= 1e-12) << away;
    EXPECT_TRUE(better.distance <= before + 1e-9) << better.distance;
    before = better.distance;
  }
  EXPECT_EQ(shown.back().motion, u.motion);
  EXPECT_FALSE(s.session.dwell().moved) << "there is nothing better";
  s.session.release();
  const SessionJournal& journal = s.session.journal();
  ASSERT_EQ(journal.gestures.back().targets.size(), 3u);
  EXPECT_TRUE(journal.gestures.back().targets[1].dwell);
  OdeContacts contacts(s.scene);
  SessionReplay replay(journal, contacts);
  while (!replay.done()) EXPECT_TRUE(replay.next().differences.empty());
}

TEST(SessionStop, WhoShowsMotionsMayFail) {
  SessionOptions options = withoutClock();
  options.drag_simulations = 1;
  BoxSession s(options);
  s.session.grab("box", 0.6);
  s.session.dragTo(s.session.grabbedPlace() + Vec3(0.2, 0.1, 0.1));
  const auto fail = [](const SessionUpdate&) { throw std::runtime_error("no window"); };
  EXPECT_THROW(s.session.dwell({}, fail), std::runtime_error);
  EXPECT_TRUE(s.session.isGrabbed());
  EXPECT_TRUE(s.session.last().moved) << "what was found is kept";
  EXPECT_TRUE(s.session.release().reached);
  OdeContacts contacts(s.scene);
  SessionReplay replay(s.session.journal(), contacts);
  while (!replay.done()) EXPECT_TRUE(replay.next().differences.empty());
}

TEST(SessionStop, DwellNeedsAGrab) {
  BoxSession s;
  EXPECT_THROW(s.session.dwell(), InputError);
}

TEST(Budget, PlacesHaveCountsOfTheirOwn) {
  std::stop_source source;
  Budget budget(2, std::numeric_limits<double>::infinity(), source.get_token());
  EXPECT_TRUE(budget.pass());
  EXPECT_EQ(budget.left(), 2) << "costs nothing";
  EXPECT_TRUE(budget.take() && budget.take());
  EXPECT_FALSE(budget.take());
  EXPECT_EQ(budget.cutAfter(), std::nullopt);
  budget.allow(1);
  EXPECT_TRUE(budget.take());
  source.request_stop();
  EXPECT_FALSE(budget.pass());
  EXPECT_EQ(budget.halt(), Halt::cancelled);
  EXPECT_EQ(budget.cutAfter(), 4);
}

}  // namespace
}  // namespace carom
