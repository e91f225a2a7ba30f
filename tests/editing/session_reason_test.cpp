// SPDX-License-Identifier: MIT
// Why a gesture is not there: what is in the way comes before that it was ended early. Work is counted, not timed; a
// turn asks for the orientation alone; and what nothing moves, by the derivatives of the motion, is freed.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;
using Kind = SessionObstacle::Kind;

SessionOptions atOnce() {
  SessionOptions options;
  options.drag_seconds = options.release_seconds = 0;
  return options;
}

/// Drags the box far up at 1 s, and lets go; each time the clock or a stop ends it at once.
void expectReason(EditSession& session, Kind kind, const std::string& words, std::stop_token stop) {
  session.grab("box", 1.0);
  session.dragTo(session.grabbedPlace() + Vec3(0.2, 0.1, 0.3), stop);
  for (int k = 0; k < 2; ++k) {
    const SessionUpdate& u = session.last();
    EXPECT_TRUE(u.cut_by_clock || u.stopped);
    EXPECT_FALSE(u.reached);
    EXPECT_EQ(u.obstacle.kind, kind) << u.message;
    EXPECT_NE(u.obstacle.sentence.find(words), std::string::npos) << u.obstacle.sentence;
    if (k == 0) session.release(stop);
  }
}

TEST(SessionReason, ComesBeforeTheClockAndTheStop) {
  std::stop_source stopped;
  stopped.request_stop();
  for (const bool by_clock : {true, false}) {
    SCOPED_TRACE(by_clock);
    const SessionOptions options = by_clock ? atOnce() : withoutClock();
    const std::stop_token stop = by_clock ? std::stop_token() : stopped.get_token();
    BoxSession nailed(options);
    nailed.session.setControls({velocity("box"), angularVelocity("box")});
    nailed.session.nailAsItIs("box", 0.3);
    expectReason(nailed.session, Kind::nails, "The nails", stop);
    BoxSession useless(options);
    useless.session.setControls({tangentialElasticity("wood")});
    useless.session.grab("box", 0.2);
    useless.session.dragTo(useless.session.grabbedPlace() + Vec3(0.2, 0, 0), stop);
    EXPECT_EQ(useless.session.last().obstacle.kind, Kind::no_control_moves_it) << useless.session.last().message;
    BoxSession bounded(options);
    bounded.session.setControls({velocity("box").only({"x"}).within(1, 1.5)});
    bounded.session.grab("box", 0.2);
    bounded.session.dragTo(bounded.session.grabbedPlace() + Vec3(0.2, 0, 0), stop);
    EXPECT_EQ(bounded.session.last().obstacle.kind, Kind::bounds) << bounded.session.last().message;
    BoxSession free(options);
    expectReason(free.session, by_clock ? Kind::clock : Kind::work, by_clock ? "The time" : "It was stopped", stop);
  }
}

TEST(SessionReason, WorkIsCountedInStepsOfSimulations) {
  SessionOptions options = withoutClock();
  options.drag_steps = options.release_steps = 1;
  BoxSession s(options);
  s.session.grab("box", 1.0);
  const SessionUpdate update = s.session.dragTo(s.session.grabbedPlace() + Vec3(0.4, 0.2, 0.3));
  EXPECT_FALSE(update.cut_by_clock || update.stopped);
  EXPECT_GE(update.simulations, 1);
  EXPECT_LE(update.simulations, 3) << "few, however many steps one takes";
  const SessionUpdate rested = s.session.dwell();
  EXPECT_TRUE(rested.simulations > 3 || rested.reached) << "a hand that rests is not spared";
  const SessionUpdate release = s.session.release();
  EXPECT_FALSE(release.cut_by_clock);
  expectSameAgain(s.session, s.scene);
}

TEST(SessionTurn, AsksForTheOrientationAlone) {
  for (const bool reversed : {false, true}) {
    SCOPED_TRACE(reversed);
    Scene scene = thrownBox();
    if (reversed) std::reverse(scene.bodies.begin(), scene.bodies.end());
    OdeContacts contacts(scene);
    EditSession session(scene, contacts, 1.2, withoutClock());
    session.vary(velocity("box"), angularVelocity("box"));
    // six numbers: with the place of an impact nailed, a turn that holds the place as well has nothing left
    const NailId nail = session.nail("box", nthImpact(1, "floor"), {.position = WantedVector(0.75, 0.15, any)});
    ASSERT_TRUE(session.last().reached);
    session.grab("box", 0.3, {.orientation = true, .place = false});
    const Quat turned = Quat(Eigen::AngleAxisd(0.25, Vec3(0.6, 0, 0.8))) * session.grabbedOrientation();
    const SessionUpdate update = session.dragTo(Vec3(9, 9, 9), turned);
    EXPECT_EQ(update.distance, 0) << "a place that is not held does not count";
    session.release();
    EXPECT_TRUE(session.last().reached) << session.last().message;
    EXPECT_LE(session.last().turn, 1e-8);
    EXPECT_TRUE(session.nailStates()[0].met);
    EXPECT_LE(session.nailStates()[0].error, 1e-6);
    EXPECT_EQ(session.constraintOf(nail).body, "box");
    session.grab("box", 0.3, {.orientation = true, .place = false});
    session.releaseNailed();
    ASSERT_EQ(session.constraintOf(session.nails().back()).targets.size(), 1u);
    EXPECT_EQ(session.constraintOf(session.nails().back()).targets[0].quantity, "orientation");
    expectSameAgain(session, scene);
    EXPECT_THROW(session.grab("box", 0.3, {.place = false}), InputError);
  }
}

/// Two boxes that each fall onto the same floor.
Scene twoOnAFloor() {
  Scene scene = thrownBox();
  Body other = scene.bodies[1];
  other.name = "other", other.material = "wood", other.position = {0, 3, 0.6}, other.velocity = {0, 0, 0};
  scene.bodies.push_back(other);
  return scene;
}

TEST(SessionFreedom, WhatNothingMovesIsFreedAndNothingElse) {
  const std::vector<Control> throwing{velocity("other").weighted(0.2), angularVelocity("other").weighted(0.2)};
  const auto freed = [&](const std::vector<Control>& controls, const std::string& body, When at) {
    const Scene scene = twoOnAFloor();
    OdeContacts contacts(scene);
    EditSession session(scene, contacts, 1.2, withoutClock());
    session.setControls(controls);
    session.grab(body, at, {}, throwing, AlsoVary::where_nothing_moves_it);
    const bool more = session.controls().size() > controls.size();
    if (more) {
      const Vec3 to = session.grabbedPlace() + Vec3(0.02, 0.03, 0);
      EXPECT_TRUE(session.dragTo(to).reached) << session.last().message;
    }
    session.cancel();
    EXPECT_EQ(session.controls().size(), controls.size());
    return more;
  };
  // both met the floor, which moves nothing on
  EXPECT_TRUE(freed({velocity("box")}, "other", 0.6));
  EXPECT_TRUE(freed({velocity("box"), elasticity("felt")}, "other", 0.2)) << "ignored before its impact";
  EXPECT_TRUE(freed({}, "other", 0.2));
  EXPECT_FALSE(freed({velocity("box")}, "box", 0.6));
  EXPECT_FALSE(freed({velocity("other")}, "other", 0.6));
  EXPECT_FALSE(freed({elasticity("wood")}, "other", 0.6));
  EXPECT_TRUE(freed({elasticity("wood")}, "other", 0.1));
  EXPECT_FALSE(freed({gravity()}, "other", 0.1));
  EXPECT_FALSE(freed({velocity("other")}, "other", nthImpact(1, "floor")));
}

// The session that was asked whether anything moves the body goes on to drag it, by the components that are held.
TEST(SessionFreedom, ComponentsThatAreFreeStayFree) {
  const Scene scene = twoOnAFloor();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 1.2, withoutClock());
  session.setControls({velocity("box")});
  Grip grip;
  grip.components = {"x", "y"};
  session.grab("box", 0.6, grip, {angularVelocity("box")}, AlsoVary::where_nothing_moves_it);
  EXPECT_EQ(session.controls().size(), 1u);
  const Vec3 to = session.grabbedPlace() + Vec3(0.02, 0.03, 1);
  ASSERT_TRUE(session.dragTo(to).reached) << session.last().message;
  const Vec3 off = session.grabbedPlace() - to;
  EXPECT_TRUE(off.head<2>().norm() <= 1e-6) << off.transpose();
  EXPECT_TRUE(std::abs(off.z()) > 0.5) << off.transpose();
}

}  // namespace
}  // namespace carom
