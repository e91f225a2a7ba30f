// SPDX-License-Identifier: MIT
// Bodies that are grabbed and nailed where they come to rest.
#include <gtest/gtest.h>

#include <cmath>

#include "adjoint/base/errors.h"
#include "tests/editing/session_scenes.h"

namespace carom {
namespace {

using namespace testing_scenes;
using namespace testing_sessions;

constexpr double kPull = 9.81, kFriction = 0.25, kDuration = 3;

/// A block that slides to a stop.
struct Stone {
  Scene scene;
  OdeContacts contacts;
  EditSession session;

  explicit Stone(double friction = kFriction, std::vector<Constraint> nails = {})
      : scene(sceneOf(friction)),
        contacts(scene),
        session(scene, contacts, kDuration, {velocity("stone"), position("stone")}, std::move(nails), withoutClock()) {}

  static Scene sceneOf(double friction) {
    Scene scene;
    scene.materials = {material("ice", 0.2, friction)};
    Body stone;
    stone.name = "stone", stone.material = "ice", stone.mass = 19;
    stone.shape = Box{{0.3, 0.3, 0.2}};
    stone.position = {0, 0, 0.1}, stone.velocity = {1.5, 0.2, 0};
    scene.bodies = {fixedPlane("floor", "ice", Vec3::UnitZ(), 0), stone};
    return scene;
  }
  Vec3 end() const { return session.motion().stateAt("stone", kDuration).position; }
  Vec3 stop() const {
    const Body& stone = session.scene().bodies[1];
    return stone.position + stone.velocity.squaredNorm() / (2 * kFriction * kPull) * stone.velocity.normalized();
  }
};

TEST(SessionRest, ABodyIsDraggedByWhereItStops) {
  Stone s;
  EditSession& session = s.session;
  session.grab("stone", atRest());
  EXPECT_TRUE((session.grabbedPlace() - s.stop()).norm() <= 1e-12);
  const Vec3 from = session.grabbedPlace(), to = from + Vec3(0.4, -0.3, 0);
  for (int k = 1; k <= 4; ++k) {
    const SessionUpdate u = session.dragTo(from + 0.25 * k * (to - from));
    EXPECT_TRUE(u.reached) << u.message;
  }
  const SessionUpdate u = session.releaseNailed();
  EXPECT_TRUE(u.reached) << u.message;
  EXPECT_TRUE((s.end() - to).norm() <= 1e-9 && (s.stop() - to).norm() <= 1e-9) << s.end().transpose();
  EXPECT_EQ(session.undoName(), "drag of 'stone' at rest");
  ASSERT_EQ(session.nails().size(), 1u);
  EXPECT_TRUE(session.constraintOf(session.nails()[0]).at.rest);
  expectSameAgain(session, s.scene);
}

TEST(SessionRest, ANailHoldsWhereItStopsWheneverThatIs) {
  Stone s;
  EditSession& session = s.session;
  const NailId nail = session.nailAsItIs("stone", atRest());
  EXPECT_FALSE(session.last().moved);
  const Vec3 held = s.end();
  const double before = session.nailStates()[0].time;
  EXPECT_TRUE(std::abs(before - s.scene.bodies[1].velocity.norm() / (kFriction * kPull)) <= 1e-12) << before;
  session.grab("stone", 0.0);
  const SessionUpdate u = session.dragTo(session.grabbedPlace() + Vec3(-0.3, 0.2, 0));
  EXPECT_TRUE(u.reached) << u.message;
  session.release();
  EXPECT_TRUE((s.end() - held).norm() <= 1e-9) << s.end().transpose();
  const NailState state = session.nailStates()[0];
  EXPECT_TRUE(state.met) << state.message;
  EXPECT_GT(state.time, before + 0.01) << "it comes from further off";

  session.grabNail(nail);
  const Vec3 other = held + Vec3(0.1, 0.1, 0);
  EXPECT_TRUE(session.dragTo(other).reached) << session.last().message;
  session.release();
  EXPECT_TRUE((s.end() - other).norm() <= 1e-9) << s.end().transpose();
  session.setNail(nail, nailConstraint("stone", atRest(), {.position = WantedVector(any, 0.5, any)}));
  EXPECT_TRUE(session.last().reached) << session.last().message;
  EXPECT_TRUE(std::abs(s.end().y() - 0.5) <= 1e-9) << s.end().transpose();
  expectSameAgain(session, s.scene);
}

TEST(SessionRest, WhatDoesNotComeToRestIsLeftOutAndNamed) {
  Stone s(0, {nailConstraint("stone", atRest(), {.position = WantedVector(1, any, any)})});
  EditSession& session = s.session;
  EXPECT_NE(session.last().message.find("ignores: 'stone' at rest."), std::string::npos) << session.last().message;
  const NailState state = session.nailStates()[0];
  EXPECT_TRUE(!state.available && std::isnan(state.time));
  EXPECT_EQ(state.message, "'stone' does not come to rest.");
  try {
    session.grab("stone", atRest());
    ADD_FAILURE() << "grabbed";
  } catch (const InputError& error) {
    EXPECT_EQ(error.message(), "found 'stone' at rest, expected a body that comes to rest within 3 s");
  }
  session.grab("stone", 1.0);
  EXPECT_TRUE(session.dragTo(session.grabbedPlace() + Vec3(0.2, 0, 0)).reached);
  session.release();
  EXPECT_THROW(session.grabNail(session.nails()[0]), InputError);
}

}  // namespace
}  // namespace carom
