// SPDX-License-Identifier: MIT
// Undo and redo, nails coming and going, bad input, and the same bits every time.
#include <gtest/gtest.h>

#include "adjoint/base/errors.h"
#include "editing/session_replay.h"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;

void dragBy(EditSession& session, const Vec3& away, double t = 0.6) {
  session.grab("box", t);
  const Vec3 start = session.grabbedPlace();
  for (int k = 1; k <= 5; ++k) session.dragTo(start + away * k / 5);
  session.release();
}

TEST(SessionHistory, UndoAndRedoBringBackTheBits) {
  BoxSession s;
  EditSession& session = s.session;
  std::vector<Scene> scenes{session.scene()};
  dragBy(session, {0.05, 0, 0.02});
  scenes.push_back(session.scene());
  const NailId nail = session.nail("box", 0.2, {.position = session.motion().stateAt("box", 0.2).position});
  scenes.push_back(session.scene());
  dragBy(session, {-0.03, 0.05, 0});
  scenes.push_back(session.scene());
  session.unnail(nail);
  EXPECT_TRUE(session.nails().empty());

  session.undo();
  ASSERT_EQ(session.nails().size(), 1u);
  EXPECT_EQ(session.nails()[0], nail);
  for (std::size_t k = 3; k-- > 0;) {
    const SessionUpdate u = session.undo();
    EXPECT_TRUE(sameScene(session.scene(), scenes[k])) << k;
    EXPECT_EQ(u.motion.get(), &session.motion());
  }
  EXPECT_TRUE(session.nails().empty());
  for (std::size_t k = 1; k < scenes.size(); ++k) {
    session.redo();
    EXPECT_TRUE(sameScene(session.scene(), scenes[k])) << k;
  }
  session.redo();
  EXPECT_FALSE(session.canRedo());
  EXPECT_EQ(session.redo().message, "There is nothing to redo.");
}

TEST(SessionHistory, ANewGestureClearsRedo) {
  BoxSession s;
  dragBy(s.session, {0.05, 0, 0});
  dragBy(s.session, {0, 0.05, 0});
  s.session.undo();
  EXPECT_TRUE(s.session.canRedo());
  dragBy(s.session, {0, 0, 0.03});
  EXPECT_FALSE(s.session.canRedo());
}

TEST(SessionHistory, UndoInAGestureCancelsIt) {
  BoxSession s;
  dragBy(s.session, {0.05, 0, 0});
  const Scene before = s.session.scene();
  s.session.grab("box", 0.7);
  s.session.dragTo(s.session.grabbedPlace() + Vec3(0.1, 0, 0));
  s.session.undo();
  EXPECT_FALSE(s.session.isGrabbed());
  EXPECT_TRUE(sameScene(s.session.scene(), before));
  EXPECT_TRUE(s.session.canUndo()) << "the gesture before it is still there";
  EXPECT_FALSE(s.session.canRedo());
}

TEST(SessionHistory, ReleasedAsANail) {
  BoxSession s;
  s.session.grab("box", 0.9);
  const Vec3 target = s.session.grabbedPlace() + Vec3(0.05, 0, 0);
  s.session.dragTo(target);
  s.session.releaseNailed();
  ASSERT_EQ(s.session.nails().size(), 1u);
  const Constraint& nail = s.session.constraintOf(s.session.nails()[0]);
  EXPECT_EQ(nail.at.time, 0.9);
  EXPECT_EQ(nail.targets.at(0).value.at(0), target.x());
  s.session.undo();
  EXPECT_TRUE(s.session.nails().empty());
  EXPECT_TRUE(sameScene(s.session.scene(), s.scene));
}

TEST(SessionHistory, ANailThatCannotBeMetStaysAndIsMetWhenItCan) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, withoutClock());
  session.vary(velocity("ball").only({"x"}));
  session.nail("ball", 0.1, {.position = session.motion().stateAt("ball", 0.1).position + Vec3(0.02, 0, 0.02)});
  EXPECT_FALSE(session.last().reached);
  EXPECT_FALSE(session.last().message.empty());
  EXPECT_EQ(session.nails().size(), 1u);
  session.vary(velocity("ball").only({"z"}));
  session.grab("ball", 0.2, {.components = {"y"}});
  const SessionUpdate u = session.dragTo(session.grabbedPlace());
  EXPECT_TRUE(u.scaled_nail_error <= 1e-9) << u.message;
}

/// The calls of one user, with everything in them.
void play(EditSession& session) {
  dragBy(session, {0.05, 0, 0.02});
  const NailId nail = session.nailAsItIs("box", 0.2);
  dragBy(session, {0, 0.04, 0});
  session.undo();
  session.redo();
  session.grab("box", 0.8, {.body_point = Vec3(0.1, 0, 0), .orientation = true});
  const Vec3 start = session.grabbedPlace();
  session.dragTo(start + Vec3(0.02, 0, 0));
  session.dragTo(start + Vec3(0.02, 0.01, 0), session.grabbedOrientation());
  session.releaseNailed();
  session.unnail(nail);
  session.vary(friction("felt"));
  session.grab("box", nthImpact(1), {.components = {"x", "y"}});
  session.dragTo(session.grabbedPlace() + Vec3(0.03, 0, 0));
  session.cancel();
  dragBy(session, {0.01, 0, 0.01}, 0.6);
}

TEST(SessionReplay, TheSameCallsGiveTheSameBits) {
  BoxSession a, b;
  play(a.session);
  play(b.session);
  EXPECT_TRUE(sameScene(a.session.scene(), b.session.scene()));
}

TEST(SessionReplay, AJournalGivesTheSameBits) {
  BoxSession s;
  play(s.session);
  const SessionJournal journal = s.session.journal();
  EXPECT_EQ(journal.gestures.size(), 11u);
  OdeContacts contacts(journal.scene);
  SessionReplay replay(journal, contacts);
  while (!replay.done()) {
    const ReplayedGesture gesture = replay.next();
    EXPECT_TRUE(gesture.differences.empty()) << gesture.differences[0];
  }
  EXPECT_TRUE(sameScene(replay.session().scene(), s.session.scene()));
  EXPECT_EQ(replay.session().nails().size(), s.session.nails().size());
}

TEST(SessionReplay, UpdatesThatTheClockCutAreCutAgain) {
  SessionOptions options;
  options.drag_seconds = 0;  // cuts at once
  options.release_seconds = 0;
  BoxSession s(options);
  s.session.grab("box", 1.0);
  const SessionUpdate u = s.session.dragTo(s.session.grabbedPlace() + Vec3(0.05, 0, 0));
  EXPECT_TRUE(u.cut_by_clock);
  EXPECT_EQ(u.stage, SessionStage::kept);
  s.session.release();
  const SessionJournal journal = s.session.journal();
  EXPECT_EQ(journal.gestures.back().targets[0].cut_after, 0);
  OdeContacts contacts(journal.scene);
  SessionReplay replay(journal, contacts);
  while (!replay.done()) EXPECT_TRUE(replay.next().differences.empty());
}

TEST(SessionReplay, SaysWhatDiffers) {
  BoxSession s;
  dragBy(s.session, {0.05, 0, 0.02});
  SessionJournal journal = s.session.journal();
  journal.gestures.back().numbers[0] += 1e-15;
  journal.gestures.back().numbers[0] *= 1 + 1e-15;
  OdeContacts contacts(journal.scene);
  SessionReplay replay(journal, contacts);
  EXPECT_TRUE(replay.next().differences.empty());
  const ReplayedGesture gesture = replay.next();
  ASSERT_EQ(gesture.differences.size(), 1u);
  EXPECT_NE(gesture.differences[0].find("velocity.x of 'box'"), std::string::npos) << gesture.differences[0];
}

/// Runs a call that must be refused, and expects the session to be as it was.
template <class Call>
void expectRefused(EditSession& session, const std::string& found, Call call) {
  SCOPED_TRACE(found);
  const Scene scene = session.scene();
  const std::size_t nails = session.nails().size(), gestures = session.journal().gestures.size();
  const bool grabbed = session.isGrabbed();
  try {
    call();
    ADD_FAILURE() << "was accepted";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(found), std::string::npos) << what;
    const bool says = what.find("expected") != std::string::npos || what.find("there is no") != std::string::npos;
    EXPECT_TRUE(says) << what;
  }
  EXPECT_TRUE(sameScene(session.scene(), scene));
  EXPECT_EQ(session.nails().size(), nails);
  EXPECT_EQ(session.journal().gestures.size(), gestures);
  EXPECT_EQ(session.isGrabbed(), grabbed);
}

TEST(SessionErrors, WithoutAGrab) {
  BoxSession s;
  EditSession& session = s.session;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expectRefused(session, "found no grabbed body", [&] { session.dragTo(Vec3::Zero()); });
  expectRefused(session, "found no grabbed body", [&] { session.release(); });
  expectRefused(session, "found no grabbed body", [&] { session.cancel(); });
  expectRefused(session, "found no grabbed body", [&] { session.grabbedPlace(); });
  expectRefused(session, "'cat'", [&] { session.grab("cat", 1.0); });
  expectRefused(session, "fixed body 'floor'", [&] { session.grab("floor", 1.0); });
  expectRefused(session, "found 3 s", [&] { session.grab("box", 3.0); });
  expectRefused(session, "found -1 s", [&] { session.grab("box", -1.0); });
  expectRefused(session, "found nan s", [&] { session.grab("box", nan); });
  expectRefused(session, "found impact 50", [&] { session.grab("box", nthImpact(50)); });
  expectRefused(session, "span of time", [&] { session.grab("box", between(0.1, 0.2)); });
  expectRefused(session, "found 'w'", [&] { session.grab("box", 1.0, {.components = {"w"}}); });
  expectRefused(session, "three finite numbers", [&] { session.grab("box", 1.0, {.body_point = Vec3(nan, 0, 0)}); });
  expectRefused(session, "'cat'", [&] { session.nail("cat", 0.5, {.position = Vec3(0, 0, 1)}); });
  expectRefused(session, "no target", [&] { session.nail("box", 0.5, {}); });
  expectRefused(session, "", [&] { session.nail("box", 50.0, {.position = Vec3(0, 0, 1)}); });
  expectRefused(session, "", [&] { session.vary(velocity("cat")); });
  expectRefused(session, "varies already", [&] { session.vary(velocity("box")); });
  const NailId nail = session.nailAsItIs("box", 0.2);
  session.unnail(nail);
  expectRefused(session, "not there", [&] { session.unnail(nail); });
}

TEST(SessionErrors, WithinAGesture) {
  BoxSession s;
  EditSession& session = s.session;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  session.grab("box", 1.0);
  expectRefused(session, "found 'box' grabbed", [&] { session.grab("box", 0.5); });
  expectRefused(session, "found 'box' grabbed", [&] { session.nailAsItIs("box", 0.5); });
  expectRefused(session, "found 'box' grabbed", [&] { session.vary(friction("felt")); });
  expectRefused(session, "found 'box' grabbed", [&] { session.redo(); });
  expectRefused(session, "nan", [&] { session.dragTo({nan, 0, 1}); });
  expectRefused(session, "inf", [&] { session.dragTo({0, 1 / 0.0, 1}); });
  expectRefused(session, "Grip::orientation", [&] { session.dragTo({0, 0, 1}, Quat::Identity()); });
  session.cancel();
  session.grab("box", 1.0, {.orientation = true});
  expectRefused(session, "length 2", [&] { session.dragTo({0, 0, 1}, Quat(2, 0, 0, 0)); });
}

TEST(SessionErrors, WithoutControls) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, withoutClock());
  session.grab("ball", 0.3);
  const SessionUpdate u = session.dragTo(session.grabbedPlace() + Vec3(0.1, 0, 0));
  EXPECT_FALSE(u.reached);
  EXPECT_NE(u.message.find("no controls"), std::string::npos) << u.message;
  EXPECT_TRUE(std::abs(u.distance - 0.1) <= 1e-12);
}

TEST(SessionSequences, AreKeptWhereTheyAreToBe) {
  BoxSession s;
  const std::size_t depth = s.session.undoDepth();
  const auto drags = [&] {
    bool left = false;
    for (const Vec3& by : {Vec3(0.3, 0, 0.2), Vec3(-0.3, 0.1, 0), Vec3(0, 0.4, 0.1), Vec3(0.1, -0.4, 0.3)}) {
      s.session.grab("box", 1.1);
      s.session.dragTo(s.session.grabbedPlace() + by);
      left = s.session.release().sequence_changed || left;
      if (s.session.undoDepth() > depth) s.session.undo();
    }
    return left;
  };
  EXPECT_TRUE(drags()) << "or nothing is tested";
  s.session.keepSequence(true);
  EXPECT_FALSE(drags());
  EXPECT_EQ(s.session.undoDepth(), depth) << "it is no step";
  s.session.keepSequence(false);
  EXPECT_TRUE(drags());
  expectSameAgain(s.session, s.scene);
}

}  // namespace
}  // namespace carom
