// SPDX-License-Identifier: MIT
// What is changed from outside, what a grab lets vary, and what sessions say as data.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "editing/problem/controls/natural_scales.hpp"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace editing_detail;
using namespace testing_scenes;
using namespace testing_sessions;

TEST(SessionContents, ReplaceAllThereIsInOneStep) {
  BoxSession s;
  EditSession& session = s.session;
  const NailId kept = session.nailAsItIs("box", 0.1), gone = session.nailAsItIs("box", 0.2);
  session.setNailOn(kept, false);
  SessionContent content = session.content();
  content.scene.bodies[1].velocity.x() = 1.7;
  Body pebble = ball("pebble", "felt", 0.05, {3, 0, 1}, {0, 0, 1});
  content.scene.bodies.push_back(pebble);
  content.duration = 0.9;
  content.controls = {velocity("pebble")};
  content.nails.pop_back();
  content.nails.push_back({NailId(), nailConstraint("pebble", 0.3, {.position = Vec3(3, 0, 1)})});
  session.setContent(content, "velocity.x of 'box'");
  EXPECT_TRUE(session.last().moved);
  EXPECT_EQ(session.undoName(), "velocity.x of 'box'");
  EXPECT_EQ(session.scene().bodies[1].velocity.x(), 1.7) << "nothing is solved";
  EXPECT_EQ(session.motion().duration, 0.9);
  EXPECT_EQ(session.duration(), 0.9);
  ASSERT_EQ(session.nails().size(), 2u);
  EXPECT_EQ(session.nails()[0], kept);
  EXPECT_FALSE(session.nailStates()[0].on) << "as it was";
  EXPECT_TRUE(session.nails()[1].value > gone.value);
  EXPECT_FALSE(session.nailStates()[1].met);

  session.grab("pebble", 0.6);
  EXPECT_FALSE(session.dragTo(session.grabbedPlace() + Vec3(0.05, 0, 0)).reached) << "the new nail holds";
  session.cancel();
  session.undo();
  EXPECT_EQ(session.duration(), 1.2);
  EXPECT_EQ(session.motion().duration, 1.2);
  EXPECT_TRUE(sameScene(session.scene(), s.scene));
  EXPECT_EQ(session.nails(), (std::vector<NailId>{kept, gone}));
  EXPECT_EQ(session.controls().size(), 3u);
  EXPECT_EQ(session.redoName(), "velocity.x of 'box'");
  session.redo();
  EXPECT_EQ(session.scene().bodies.size(), 3u);
  expectSameAgain(session, s.scene);
}

TEST(SessionContents, WhatMakesNoSenseIsRefusedWhole) {
  BoxSession s;
  EditSession& session = s.session;
  const NailId nail = session.nailAsItIs("box", 0.1);
  const SessionContent good = session.content();
  const std::size_t gestures = session.journal().gestures.size();
  const auto refused = [&](const std::string& found, auto change) {
    SCOPED_TRACE(found);
    SessionContent content = good;
    change(content);
    try {
      session.setContent(content, "change");
      ADD_FAILURE() << "was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(found), std::string::npos) << error.what();
    }
    EXPECT_TRUE(sameScene(session.scene(), s.scene));
    EXPECT_EQ(session.nails(), std::vector<NailId>{nail});
    EXPECT_EQ(session.duration(), 1.2);
    EXPECT_EQ(session.journal().gestures.size(), gestures);
    EXPECT_EQ(session.undoName(), "nail of 'box' at 0.1 s");
  };
  refused("/duration", [](SessionContent& c) { c.duration = 0; });
  refused("nan", [](SessionContent& c) { c.scene.bodies[1].velocity.x() = std::nan(""); });
  refused("overlap", [](SessionContent& c) { c.scene.bodies[1].position.z() = 0; });
  refused("'box'", [](SessionContent& c) { c.scene.bodies.pop_back(); });
  refused("varies already", [](SessionContent& c) { c.controls.push_back(velocity("box")); });
  refused("not there", [](SessionContent& c) { c.nails[0].first = {7}; });
  refused("twice", [](SessionContent& c) { c.nails.push_back(c.nails[0]); });
  session.grab("box", 0.5);
  EXPECT_THROW(session.setContent(good, ""), InputError);
  session.cancel();
}

TEST(SessionContents, NumbersSayWhatMayBeDoneWithThem) {
  BoxSession s;
  EditSession& session = s.session;
  session.setControls({velocity("box").only({"x", "z"}).within(-2, 3).weighted(2), mass("box"), orientation("box")});
  const std::vector<SessionNumber> numbers = session.numbers();
  ASSERT_EQ(numbers.size(), 8u);
  EXPECT_EQ(numbers[0].name, "velocity.x of 'box'");
  EXPECT_EQ(numbers[0].component, "x");
  EXPECT_EQ(numbers[0].value, s.scene.bodies[1].velocity.x());
  EXPECT_TRUE(numbers[0].varies && !numbers[1].varies && numbers[2].varies);
  EXPECT_EQ(numbers[2].min, -2);
  EXPECT_EQ(numbers[2].max, 3);
  EXPECT_TRUE(std::isinf(numbers[1].min) && std::isinf(numbers[1].max));
  const double diameter = Vec3(0.3, 0.2, 0.1).norm();
  EXPECT_TRUE(std::abs(numbers[0].scale - std::sqrt(9.81 * diameter)) <= 1e-3) << numbers[0].scale;
  EXPECT_EQ(numbers[3].name, "mass of 'box'");
  EXPECT_EQ(numbers[3].control, 1);
  EXPECT_EQ(numbers[3].min, 0);
  EXPECT_TRUE(std::abs(numbers[3].scale - kMassScale * numbers[3].value) <= 1e-15);
  EXPECT_EQ(numbers[4].component, "w");
  EXPECT_EQ(numbers[7].control, 2);
}

TEST(SessionContents, AGrabMayLetMoreVary) {
  BoxSession s;
  EditSession& session = s.session;
  session.setControls({elasticity("felt")});
  session.grab("box", 0.2);
  SessionUpdate u = session.dragTo(session.grabbedPlace() + Vec3(0.05, 0, 0));
  EXPECT_EQ(u.obstacle.kind, SessionObstacle::Kind::no_control_moves_it) << u.message;
  EXPECT_EQ(u.obstacle.sentence, "No control moves 'box' at 0.2 s.");
  session.cancel();

  const std::vector<Control> throws{velocity("box").weighted(0.2), angularVelocity("box").weighted(0.2)};
  session.grab("box", 0.2, {}, throws);
  EXPECT_EQ(session.controls().size(), 3u);
  u = session.dragTo(session.grabbedPlace() + Vec3(0.05, 0, 0));
  EXPECT_TRUE(u.reached && u.moved) << u.message;
  EXPECT_EQ(u.obstacle.kind, SessionObstacle::Kind::none);
  session.cancel();
  EXPECT_EQ(session.controls().size(), 1u);
  EXPECT_TRUE(sameScene(session.scene(), s.scene));

  session.grab("box", 0.2, {}, throws);
  session.dragTo(session.grabbedPlace() + Vec3(0.05, 0, 0));
  session.release();
  EXPECT_EQ(session.controls().size(), 3u);
  EXPECT_EQ(session.undoName(), "drag of 'box' at 0.2 s");
  session.undo();
  EXPECT_EQ(session.controls().size(), 1u) << "one step takes both back";
  EXPECT_TRUE(sameScene(session.scene(), s.scene));
  session.redo();
  EXPECT_THROW(session.grab("box", 0.2, {}, throws), InputError) << "they vary already";
  EXPECT_FALSE(session.isGrabbed());
  expectSameAgain(session, s.scene);
}

TEST(SessionContents, ABodyThatNoControlMovesSaysSoInACrowd) {
  Scene scene = thrownBox();
  for (int i = 0; i < 3; ++i) {
    scene.bodies.push_back(ball("ball " + std::to_string(i), "felt", 0.05, {2.0 + i, 0, 1}, {0, 0, 1}));
  }
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.5, {velocity("box")}, {}, withoutClock());
  session.nailAsItIs("box", 0.1);
  session.grab("ball 1", 0.2);
  const SessionUpdate u = session.dragTo(session.grabbedPlace() + Vec3(0.05, 0, 0));
  EXPECT_EQ(u.obstacle.kind, SessionObstacle::Kind::no_control_moves_it) << u.message;
  EXPECT_NE(u.message.find("No control moves 'ball 1'"), std::string::npos) << u.message;
}

TEST(SessionContents, ObstaclesAreData) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, {velocity("ball").within(-6, 6).only({"x", "z"})}, {}, withoutClock());
  session.grab("ball", 0.1);
  const Vec3 start = session.grabbedPlace();
  SessionUpdate u;
  for (int k = 0; k < 4; ++k) u = session.dragTo(start + Vec3(0.5, 0, 0));
  EXPECT_EQ(u.obstacle.kind, SessionObstacle::Kind::bounds) << u.message;
  EXPECT_EQ(u.obstacle.at_bounds, std::vector<std::string>{"velocity.x of 'ball'"});
  EXPECT_EQ(u.obstacle.sentence, "It would take velocity.x of 'ball' beyond its bound.");
  u = session.dragTo(start + Vec3(0, 0.3, 0));
  EXPECT_EQ(u.obstacle.kind, SessionObstacle::Kind::no_control_moves_it) << u.message;
  session.cancel();

  session.nailAsItIs("ball", 0.05);
  session.grab("ball", 0.1, {.components = {"x"}});
  u = session.dragTo(start + Vec3(0.05, 0, 0));
  EXPECT_EQ(u.obstacle.kind, SessionObstacle::Kind::nails) << u.message;
  session.cancel();
  EXPECT_EQ(session.last().obstacle.kind, SessionObstacle::Kind::none);
  EXPECT_STREQ(nameOf(u.obstacle.kind), "nails");
}

TEST(SessionContents, SequenceChangesAreEventsOfBothMotions) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, {velocity("ball").only({"x", "z"}).within(-5.2, 5.2)}, {}, withoutClock());
  const Motion before = session.motion();
  session.grab("ball", 0.6, {.components = {"x", "z"}});
  const Vec3 start = session.grabbedPlace();
  SessionUpdate u;
  for (int k = 1; k <= 60; ++k) {
    u = session.dragTo(start - Vec3(0.5 * k / 60, 0, 0));
    EXPECT_EQ(u.sequence_changed, !u.sequence_changes.empty());
    for (const SequenceChange& change : u.sequence_changes) {
      EXPECT_LT(change.before, static_cast<int>(before.events.size()));
      EXPECT_LT(change.after, static_cast<int>(u.motion->events.size()));
    }
  }
  ASSERT_FALSE(u.sequence_changes.empty()) << u.message;
  EXPECT_NE(u.message.find("The impacts have changed: 'wall' and 'ball' meet once less."), std::string::npos)
      << u.message;
  EXPECT_EQ(u.sequence_changes[0].kind, SequenceChange::Kind::went);
  EXPECT_TRUE(before.events[static_cast<std::size_t>(u.sequence_changes[0].before)].touches(2, 1));
}

TEST(SessionContents, StepsHaveNames) {
  BoxSession s;
  EditSession& session = s.session;
  EXPECT_EQ(session.undoName(), "change of the controls");
  session.grab("box", nthImpact(1, "floor"), {.components = {"x"}});
  EXPECT_EQ(session.undoName(), "drag of 'box' at its impact 1 with 'floor'");
  EXPECT_EQ(session.redoName(), "");
  session.dragTo(session.grabbedPlace() + Vec3(0.02, 0, 0));
  session.release();
  const NailId nail = session.nailAsItIs("box", 0.123456);
  EXPECT_EQ(session.undoName(), "nail of 'box' at 0.123 s");
  session.unnail(nail);
  EXPECT_EQ(session.undoName(), "removal of the nail of 'box' at 0.123 s");
  session.undo();
  EXPECT_EQ(session.redoName(), "removal of the nail of 'box' at 0.123 s");
  session.undo();
  EXPECT_EQ(session.undoName(), "drag of 'box' at its impact 1 with 'floor'");
  EXPECT_EQ(session.redoName(), "nail of 'box' at 0.123 s");
  session.undo();
  session.undo();
  EXPECT_EQ(session.undoName(), "");
  EXPECT_EQ(session.redoName(), "change of the controls");
}

}  // namespace
}  // namespace carom
