// SPDX-License-Identifier: MIT
// Nails of sessions: missing ones, switched off ones, moved ones, and drags of nails themselves.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;

Vec3 placeOf(const EditSession& session, double t) { return session.motion().stateAt("box", t).position; }

TEST(SessionNails, OneThatTheMotionLacksIsLeftOutAndNamed) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  const std::vector<Constraint> nails = {
      nailConstraint("box", nthImpact(40, "floor"), {.position = WantedVector(0.5, any, any)}),
      nailConstraint("box", 0.2, {.velocity = WantedVector(any, 0.2, any)})};
  EditSession session(scene, contacts, 1.2, {velocity("box")}, nails, withoutClock());
  EXPECT_NE(session.last().message.find("'box' at its impact 40 with 'floor'"), std::string::npos)
      << session.last().message;
  const std::vector<NailState> states = session.nailStates();
  ASSERT_EQ(states.size(), 2u);
  EXPECT_TRUE(states[0].on && !states[0].available && !states[0].met);
  EXPECT_TRUE(std::isnan(states[0].error) && std::isnan(states[0].time));
  EXPECT_EQ(states[0].message, "Impact 40 with 'floor' of 'box' does not come.");
  EXPECT_TRUE(states[1].available && states[1].met) << states[1].message;
  EXPECT_EQ(states[1].time, 0.2);

  session.grab("box", 0.3, {.components = {"x", "z"}});
  EXPECT_TRUE(session.last().reached) << "of the nails only those that there are count";
  const SessionUpdate u = session.dragTo(session.grabbedPlace() + Vec3(0.05, 0, 0.02));
  EXPECT_TRUE(u.reached) << u.message;
  EXPECT_TRUE(u.scaled_nail_error <= 1e-9);
  EXPECT_EQ(session.constraints().size(), 3u) << "what is saved has all nails";
  const SessionUpdate released = session.release();
  EXPECT_NE(released.message.find("ignores: 'box' at its impact 40"), std::string::npos) << released.message;
  session.nailAsItIs("box", 0.6);
  EXPECT_EQ(session.nails().size(), 3u);
  expectSameAgain(session, scene);
}

TEST(SessionNails, AtAnImpactTheTimeIsWhereItIsNow) {
  BoxSession s;
  EditSession& session = s.session;
  session.nail("box", nthImpact(1, "floor"), {.position = WantedVector(0.9, any, any)});
  ASSERT_TRUE(session.last().reached) << session.last().message;
  const double before = session.nailStates()[0].time;
  EXPECT_EQ(before, session.motion().events[0].time);
  session.grab("box", 0.2, {.components = {"z"}});
  session.dragTo(session.grabbedPlace() + Vec3(0, 0, 0.1));
  session.release();
  const NailState state = session.nailStates()[0];
  EXPECT_TRUE(state.met) << state.message;
  EXPECT_GT(std::abs(state.time - before), 1e-3);
}

TEST(SessionNails, OffTheyAreKeptAndNotConstrained) {
  BoxSession s;
  EditSession& session = s.session;
  const NailId nail = session.nail("box", 0.6, {.position = placeOf(session, 0.6)});
  session.setNailOn(nail, false);
  EXPECT_EQ(session.undoName(), "nail of 'box' at 0.6 s switched off");
  session.grab("box", 0.6);
  const SessionUpdate u = session.dragTo(session.grabbedPlace() + Vec3(0.1, 0, 0));
  EXPECT_TRUE(u.reached) << u.message;
  session.release();
  NailState state = session.nailStates()[0];
  EXPECT_TRUE(!state.on && state.available && !state.met);
  EXPECT_TRUE(std::abs(state.error - 0.1) <= 1e-6) << state.error;
  EXPECT_EQ(state.message, "position.x is off by 0.1 m.");
  EXPECT_TRUE(session.last().reached) << "it is not held";
  session.undo();
  session.undo();
  EXPECT_TRUE(session.nailStates()[0].on);
  session.redo();
  session.redo();
  session.setNailOn(nail, true);
  EXPECT_FALSE(session.last().reached);
  EXPECT_FALSE(session.last().moved) << "nothing moves by itself";
  const SessionUpdate met = session.meetNails();
  EXPECT_TRUE(met.reached && met.moved) << met.message;
  EXPECT_TRUE(session.nailStates()[0].met);
  expectSameAgain(session, s.scene);
}

TEST(SessionNails, GoalsThatAreNotMetBeginOffAndAreMetTogether) {
  const Scene scene = thrownBox();
  OdeContacts contacts(scene);
  EditSession start(scene, contacts, 1.2);
  const Vec3 early = placeOf(start, 0.2), late = placeOf(start, 0.35);
  SessionOptions options = withoutClock();
  options.unmet_nails_off = true;
  EditSession session(scene, contacts, 1.2, {velocity("box"), position("box")},
                      {nailConstraint("box", 0.2, {.position = Vec3(early + Vec3(0.02, 0.01, 0))}),
                       nailConstraint("box", 0.35, {.position = Vec3(late + Vec3(0, 0, 0.03))}),
                       nailConstraint("box", 0.0, {.velocity = scene.bodies[1].velocity})},
                      options);
  EXPECT_FALSE(session.canUndo());
  std::vector<NailState> states = session.nailStates();
  EXPECT_TRUE(!states[0].on && !states[1].on && states[2].on);
  EXPECT_TRUE(session.last().reached);
  session.grab("box", 0.1);
  const SessionUpdate still = session.dragTo(session.grabbedPlace());
  EXPECT_FALSE(still.moved);
  session.cancel();
  EXPECT_EQ(session.meetNails().obstacle.kind, SessionObstacle::Kind::nails) << "the velocity stands against them";
  session.undo();
  session.unnail(session.nails()[2]);
  const SessionUpdate met = session.meetNails();
  EXPECT_TRUE(met.reached) << met.message;
  EXPECT_EQ(session.undoName(), "meeting all nails");
  for (const NailState& state : session.nailStates()) EXPECT_TRUE(state.on && state.met) << state.message;
  EXPECT_EQ(session.meetNails().moved, false);
  EXPECT_EQ(session.undoName(), "meeting all nails") << "nothing changed: no step";
  session.undo();
  EXPECT_TRUE(sameScene(session.scene(), scene));
  EXPECT_FALSE(session.nailStates()[0].on);
  expectSameAgain(session, scene);
}

TEST(SessionNails, AnotherTargetForTheSameNail) {
  BoxSession s;
  EditSession& session = s.session;
  const NailId nail = session.nailAsItIs("box", 0.3), other = session.nailAsItIs("box", 0.0);
  const Vec3 place = placeOf(session, 0.4) + Vec3(0, 0.05, 0);
  session.unnail(other);
  session.setNail(nail, nailConstraint("box", 0.4, {.position = place}));
  EXPECT_TRUE(session.last().reached) << session.last().message;
  EXPECT_TRUE((placeOf(session, 0.4) - place).norm() <= 1e-9);
  EXPECT_EQ(session.nails(), std::vector<NailId>{nail});
  EXPECT_EQ(session.constraintOf(nail).targets.size(), 1u);
  EXPECT_EQ(session.undoName(), "change of the nail of 'box' at 0.3 s");
  const Scene moved = session.scene();
  EXPECT_THROW(session.setNail(other, nailConstraint("box", 0.4, {.position = place})), InputError);
  EXPECT_THROW(session.setNail(nail, nailConstraint("hat", 0.4, {.position = place})), InputError);
  EXPECT_THROW(session.setNail(nail, nailConstraint("box", 7.0, {.position = place})), InputError);
  EXPECT_TRUE(sameScene(session.scene(), moved));
  session.undo();
  EXPECT_EQ(session.constraintOf(nail).at.time, 0.3);
  session.setNailOn(nail, false);
  session.setNail(nail, nailConstraint("box", 0.1, {.position = Vec3(5, 5, 5)}));
  EXPECT_FALSE(session.last().moved) << "it is off";
  EXPECT_THROW(session.setNail(nail, nailConstraint("box", 0.1, {})), InputError);
  expectSameAgain(session, s.scene);
}

TEST(SessionNails, OneIsDraggedAndStaysWhereItGotTo) {
  BoxSession s;
  EditSession& session = s.session;
  const Vec3 held = placeOf(session, 0.5);
  const NailId nail = session.nail("box", 0.5, {.position = WantedVector(held.x(), any, held.z())});
  session.grabNail(nail);
  EXPECT_TRUE(session.isGrabbed());
  EXPECT_EQ(session.undoName(), "drag of the nail of 'box' at 0.5 s");
  const SessionUpdate u = session.dragTo(held + Vec3(0.1, 7, 0.05));
  EXPECT_TRUE(u.reached) << u.message;
  EXPECT_EQ(session.constraintOf(nail).targets[0].value[0], held.x() + 0.1);
  EXPECT_TRUE(std::isnan(session.constraintOf(nail).targets[0].value[1])) << "a free component stays free";
  EXPECT_EQ(session.constraints().size(), 1u);
  session.cancel();
  EXPECT_EQ(session.constraintOf(nail).targets[0].value[0], held.x());
  EXPECT_TRUE(sameScene(session.scene(), s.scene));

  session.grabNail(nail);
  session.dragTo(held + Vec3(0.1, 0, 0.05));
  session.release();
  EXPECT_EQ(session.nails(), std::vector<NailId>{nail});
  EXPECT_TRUE(session.nailStates()[0].met);
  EXPECT_TRUE(std::abs(placeOf(session, 0.5).x() - held.x() - 0.1) <= 1e-9);
  session.undo();
  EXPECT_EQ(session.constraintOf(nail).targets[0].value[0], held.x());
  session.redo();
  expectSameAgain(session, s.scene);
}

TEST(SessionNails, OutOfReachTheyStayInReach) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, {velocity("ball").within(-6, 6).only({"x", "z"})}, {}, withoutClock());
  const auto place = [&] { return session.motion().stateAt("ball", 0.1).position; };
  const Vec3 far = place() + Vec3(51, 0, 0);
  session.grab("ball", 0.1, {.components = {"x"}});
  session.dragTo(far);
  const SessionUpdate u = session.releaseNailed(NailAt::where_it_got);
  EXPECT_FALSE(u.reached);
  const NailId nail = session.nails().at(0);
  EXPECT_EQ(session.constraintOf(nail).targets[0].value[0], place().x());
  EXPECT_TRUE(session.nailStates()[0].met);

  session.grabNail(nail);
  session.dragTo(far);
  session.release();
  EXPECT_TRUE(session.nailStates()[0].met) << "put where it got to";
  session.grabNail(nail);
  session.dragTo(far);
  session.releaseNailed();
  EXPECT_EQ(session.constraintOf(nail).targets[0].value[0], far.x());
  EXPECT_FALSE(session.nailStates()[0].met);
  EXPECT_EQ(session.nails().size(), 1u) << "no new one";
  session.grab("ball", 0.1, {.components = {"z"}});
  session.dragTo(far);
  session.releaseNailed();
  EXPECT_EQ(session.nails().size(), 2u);
  expectSameAgain(session, scene);
}

TEST(SessionNails, WhatADraggedNailHoldsBesidesItsPlaceIsKept) {
  BoxSession s;
  EditSession& session = s.session;
  session.vary(position("box"), orientation("box"));
  const BodyState at = session.motion().stateAt("box", 0.3);
  const NailId nail = session.nail(
      "box", 0.3, {.position = at.position, .orientation = at.orientation, .velocity = WantedVector(at.velocity)});
  session.grabNail(nail);
  const Quat turned = Quat(Eigen::AngleAxisd(0.2, Vec3::UnitZ())) * at.orientation;
  const SessionUpdate u = session.dragTo(at.position + Vec3(0.05, 0.02, 0), turned);
  EXPECT_TRUE(u.reached) << u.message;
  const BodyState now = u.motion->stateAt("box", 0.3);
  EXPECT_TRUE((now.velocity - at.velocity).norm() <= 1e-8);
  EXPECT_TRUE(now.orientation.angularDistance(turned) <= 1e-8);
  session.release();
  EXPECT_TRUE(session.nailStates()[0].met) << session.nailStates()[0].message;
  EXPECT_EQ(session.constraintOf(nail).targets.size(), 3u);
  expectSameAgain(session, s.scene);
}

TEST(SessionNails, WhichCannotBeDragged) {
  BoxSession s;
  EditSession& session = s.session;
  const auto refused = [&](NailId nail, const std::string& found) {
    try {
      session.grabNail(nail);
      ADD_FAILURE() << "was grabbed";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(found), std::string::npos) << error.what();
    }
    EXPECT_FALSE(session.isGrabbed());
  };
  const BodyState at = session.motion().stateAt("box", 0.3);
  refused({4}, "not there");
  refused(session.nail("box", 0.3, {.velocity = WantedVector(at.velocity)}), "without a position");
  Constraint seen = nailConstraint("box", 0.3, {.position = Vec3(at.position)});
  seen.relative_to = "floor";
  refused(session.nail(seen), "relative to 'floor'");
  seen = nailConstraint("box", between(0.25, 0.35), {.position = WantedVector(at.position.x(), any, any)});
  refused(session.nail(seen), "some time of a span");
}

}  // namespace
}  // namespace carom
