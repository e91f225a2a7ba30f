// SPDX-License-Identifier: MIT
// Drags: that the motion shown is true, that it follows, what stays as it was, and where it cannot follow.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/simulate/simulate.h"
#include "editing/session.h"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;

/// What every update must keep: its motion is that of its scene, and it says truly where the body is.
void expectVerified(const SessionUpdate& u, ContactSource& contacts, double duration, const std::string& body, double t,
                    const Vec3& target) {
  ASSERT_TRUE(u.motion);
  const Motion again = simulate(u.scene(), contacts, duration);
  EXPECT_EQ(again.signature(), u.motion->signature());
  EXPECT_EQ(u.motion->duration, duration);
  const double away = (again.stateAt(body, t).position - target).norm();
  EXPECT_TRUE(std::abs(away - u.distance) <= 1e-10 * (1 + away)) << away << " " << u.distance;
  if (!u.reached) {
    EXPECT_FALSE(u.message.empty());
  }
}

TEST(SessionDrag, FollowsTheTargetFrameByFrame) {
  BoxSession s;
  const SessionUpdate held = s.session.grab("box", 0.6);
  EXPECT_EQ(held.stage, SessionStage::kept);
  EXPECT_LE(held.distance, 1e-12);
  const Vec3 start = s.session.grabbedPlace();
  for (int k = 1; k <= 20; ++k) {
    const Vec3 target = start + k * Vec3(0.01, 0.004, 0.003);
    const SessionUpdate u = s.session.dragTo(target);
    expectVerified(u, s.contacts, 1.2, "box", 0.6, target);
    EXPECT_TRUE(u.reached) << k << " " << u.message;
    EXPECT_NE(u.stage, SessionStage::kept) << k;
    EXPECT_LE(u.simulations, s.session.options().drag_simulations);
  }
  const SessionUpdate u = s.session.release();
  EXPECT_TRUE(u.reached);
  EXPECT_EQ(u.stage, SessionStage::solved);
  EXPECT_FALSE(s.session.isGrabbed());
}

TEST(SessionDrag, EndsWhereAnEditWouldEnd) {
  BoxSession s;
  s.session.grab("box", 0.6);
  // well within the impact sequence: where the smallest change lies at its end, an edit that must stay may not get there
  const Vec3 target = s.session.grabbedPlace() + Vec3(0.05, 0.03, 0.01);
  for (int k = 1; k <= 10; ++k)
    s.session.dragTo(s.session.grabbedPlace() + (target - s.session.grabbedPlace()) * k / 10);
  const SessionUpdate u = s.session.release();
  ASSERT_TRUE(u.reached) << u.message;

  Edit edit(s.scene, s.contacts, 1.2);
  edit.vary(velocity("box"), angularVelocity("box"), elasticity("felt"));
  edit.nail("box", 0.6).position(target);
  EditOptions options;
  options.sequence = SequencePolicy::stay;  // as a drag keeps to it where it can
  const EditResult r = edit.solve(options);
  ASSERT_EQ(r.status, EditStatus::solved) << r.message;
  EXPECT_TRUE((u.scene().bodies[1].velocity - r.scene.bodies[1].velocity).norm() <= 1e-5);
  EXPECT_TRUE((u.scene().bodies[1].angular_velocity - r.scene.bodies[1].angular_velocity).norm() <= 1e-5);
}

TEST(SessionDrag, BackAtTheStartNothingChanged) {
  BoxSession s;
  s.session.grab("box", 0.6);
  const Vec3 start = s.session.grabbedPlace();
  for (double reach : {0.02, 0.05, 0.03, 0.01}) s.session.dragTo(start + Vec3(reach, 0, 0));
  const SessionUpdate u = s.session.dragTo(start);
  EXPECT_TRUE(u.reached);
  EXPECT_TRUE(sameScene(u.scene(), s.scene));
  s.session.release();
  EXPECT_EQ(s.session.undo().message, "") << "setControls";
  EXPECT_FALSE(s.session.canUndo());
}

TEST(SessionDrag, NailsHold) {
  BoxSession s;
  s.session.vary(position("box"), orientation("box"));
  const BodyState nailed = s.session.motion().stateAt("box", 0.25);
  s.session.nailAsItIs("box", 0.25);
  EXPECT_TRUE(s.session.last().reached);
  s.session.grab("box", 0.6);
  const Vec3 start = s.session.grabbedPlace();
  for (int k = 1; k <= 12; ++k) {
    const SessionUpdate u = s.session.dragTo(start + k * Vec3(0.008, -0.004, 0.002));
    EXPECT_TRUE(u.scaled_nail_error <= 1e-9) << k;
    EXPECT_TRUE(u.reached) << k << " " << u.message;
    const BodyState now = u.motion->stateAt("box", 0.25);
    EXPECT_TRUE((now.position - nailed.position).norm() <= 1e-9);
    EXPECT_TRUE(now.orientation.angularDistance(nailed.orientation) <= 1e-8);
  }
}

TEST(SessionDrag, APointOfTheBodyAndItsOrientation) {
  BoxSession s;
  const Vec3 corner(0.15, 0.1, 0.05);
  s.session.grab("box", 0.3, {.body_point = corner, .orientation = true});
  const Vec3 start = s.session.grabbedPlace();
  const Quat turned = Quat(Eigen::AngleAxisd(0.1, Vec3::UnitZ())) * s.session.grabbedOrientation();
  const SessionUpdate u = s.session.dragTo(start + Vec3(0.02, 0, 0.01), turned);
  ASSERT_TRUE(u.reached) << u.message;
  const BodyState state = u.motion->stateAt("box", 0.3);
  EXPECT_TRUE((state.position + state.orientation * corner - start - Vec3(0.02, 0, 0.01)).norm() <= 1e-9);
  EXPECT_TRUE(state.orientation.angularDistance(turned) <= 1e-8);
  EXPECT_TRUE(u.turn <= 1e-8);
}

TEST(SessionDrag, FreeComponentsAreFree) {
  BoxSession s;
  s.session.setControls({velocity("box").only({"x"})});
  s.session.grab("box", 0.3, {.components = {"x"}});
  const Vec3 start = s.session.grabbedPlace();
  const SessionUpdate u = s.session.dragTo(start + Vec3(0.1, 5, 5));
  EXPECT_TRUE(u.reached) << u.message;
  EXPECT_TRUE(u.distance <= 1e-9);
}

TEST(SessionDrag, AtAnImpact) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, withoutClock());
  session.vary(velocity("ball").only({"x", "z"}));
  session.grab("ball", nthImpact(1, "wall"), {.components = {"z"}});
  const Vec3 start = session.grabbedPlace();
  const SessionUpdate u = session.dragTo(start + Vec3(0, 0, 0.1));
  ASSERT_TRUE(u.reached) << u.message;
  const Motion& motion = *u.motion;
  const int event = *motion.findImpact(2, 1, 1);
  EXPECT_TRUE(std::abs(motion.stateBefore(event, 2).position.z() - start.z() - 0.1) <= 1e-9);
}

TEST(SessionDrag, OutOfReachItComesNearestAndSaysWhy) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, withoutClock());
  session.vary(velocity("ball").within(-6, 6).only({"x", "z"}));
  session.grab("ball", 0.1);
  const Vec3 start = session.grabbedPlace();
  SessionUpdate u;
  for (int k = 0; k < 4; ++k) u = session.dragTo(start + Vec3(0.5, 0.3, 0));
  EXPECT_FALSE(u.reached);
  expectVerified(u, contacts, 0.6, "ball", 0.1, start + Vec3(0.5, 0.3, 0));
  // vx at its bound of 6 is 0.1 m further in 0.1 s; nothing moves it along y
  EXPECT_TRUE(std::abs(u.scene().bodies[2].velocity.x() - 6) <= 1e-9) << u.scene().bodies[2].velocity.x();
  EXPECT_TRUE(std::abs(u.distance - std::hypot(0.4, 0.3)) <= 1e-6) << u.distance;
  EXPECT_NE(u.message.find("velocity.x of 'ball'"), std::string::npos) << u.message;
  // and back into reach
  u = session.dragTo(start + Vec3(0.05, 0, 0));
  EXPECT_TRUE(u.reached) << u.message;
}

TEST(SessionDrag, NailsThatLeaveNothingFree) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, withoutClock());
  session.vary(velocity("ball"));
  session.nailAsItIs("ball", 0.05);
  session.grab("ball", 0.1);
  const SessionUpdate u = session.dragTo(session.grabbedPlace() + Vec3(0.1, 0, 0));
  EXPECT_FALSE(u.reached);
  EXPECT_TRUE(u.scaled_nail_error <= 1e-9) << u.scaled_nail_error;
  EXPECT_NE(u.message.find("nails leave no freedom"), std::string::npos) << u.message;
}

TEST(SessionDrag, AnyBudgetGivesAVerifiedMotion) {
  for (int budget : {0, 1, 2}) {
    SCOPED_TRACE(budget);
    SessionOptions options = withoutClock();
    options.drag_simulations = budget;
    options.release_iterations = budget;
    BoxSession s(options);
    s.session.grab("box", 0.6);
    const Vec3 target = s.session.grabbedPlace() + Vec3(0.02, 0.01, 0.01);
    const SessionUpdate u = s.session.dragTo(target);
    expectVerified(u, s.contacts, 1.2, "box", 0.6, target);
    EXPECT_LE(u.simulations, budget);
    if (budget == 0) {
      EXPECT_EQ(u.stage, SessionStage::kept);
      EXPECT_TRUE(sameScene(u.scene(), s.scene));
    }
    if (budget == 1) {
      EXPECT_EQ(u.stage, SessionStage::predicted);
      EXPECT_LT(u.distance, 0.012);  // of 0.024
    }
    expectVerified(s.session.release(), s.contacts, 1.2, "box", 0.6, target);
  }
}

// A ball that may hardly be faster gets no farther back from the wall: one that does not come to it does.
TEST(SessionDrag, AcrossASequenceChangeAndBack) {
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, withoutClock());
  session.vary(velocity("ball").only({"x", "z"}).within(-5.2, 5.2));
  session.grab("ball", 0.6, {.components = {"x", "z"}});
  const Vec3 start = session.grabbedPlace();
  bool left = false;
  SessionUpdate u;
  const auto follow = [&](double from, double to) {
    for (int k = 1; k <= 60; ++k) {
      const Vec3 target = start + Vec3((from + (to - from) * k / 60), 0, 0);
      u = session.dragTo(target);
      EXPECT_EQ(u.motion->duration, 0.6);
      EXPECT_EQ(u.sequence_changed, u.message.find("mpact") != std::string::npos) << u.message;
      left = left || u.sequence_changed;
    }
    EXPECT_TRUE(u.reached) << u.message;
  };
  follow(0, -0.5);
  EXPECT_TRUE(left);
  follow(-0.5, 0);
  EXPECT_TRUE((u.motion->stateAt("ball", 0.6).position - start).norm() <= 1e-8);
}

TEST(SessionDrag, StayNeverLeavesTheSequence) {
  SessionOptions options = withoutClock();
  options.sequence = SequencePolicy::stay;
  const Scene scene = floorAndWall();
  OdeContacts contacts(scene);
  EditSession session(scene, contacts, 0.6, options);
  session.vary(velocity("ball").only({"x", "z"}));
  session.grab("ball", 0.6);
  const Vec3 start = session.grabbedPlace();
  for (int k = 1; k <= 60; ++k) EXPECT_FALSE(session.dragTo(start + Vec3(0.02 * k, 0, 0)).sequence_changed) << k;
  EXPECT_FALSE(session.release().sequence_changed);
}

TEST(SessionDrag, MeasuredFromTheStartGesturesDoNotAddUp) {
  SessionOptions options = withoutClock();
  options.measure_from = MeasureFrom::start;
  BoxSession s(options);
  const Vec3 start = s.session.motion().stateAt("box", 0.6).position;
  for (const Vec3& away : {Vec3(0.05, 0, 0.02), Vec3(0, 0.04, 0), Vec3(0, 0, 0)}) {
    s.session.grab("box", 0.6);
    s.session.dragTo(start + away);
    EXPECT_TRUE(s.session.release().reached);
  }
  EXPECT_TRUE((s.session.scene().bodies[1].velocity - s.scene.bodies[1].velocity).norm() <= 1e-6);
  EXPECT_TRUE((s.session.scene().bodies[1].angular_velocity - s.scene.bodies[1].angular_velocity).norm() <= 1e-6);
}

}  // namespace
}  // namespace carom
