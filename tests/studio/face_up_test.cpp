// SPDX-License-Identifier: MIT
// A die that comes to rest with a chosen face up at a chosen place: by the same throw, held another way round and thrown from
// elsewhere, or by an edit within its controls.
#include "studio/face_up.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "adjoint/simulate/simulate.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

struct FacesUp : testing::Test {
  Document document = readDocument(projectFile("examples/scenes/die-at-rest.json"));
  std::vector<int> told;
  std::stop_source stop;

  SessionSnapshot snapshot(std::vector<Control> controls) const {
    SessionSnapshot now;
    now.began = document.scene;
    now.content = {document.scene, document.duration, std::move(controls), {}};
    return now;
  }
  FaceUpFound find(const SessionSnapshot& now, const FaceUp& face) {
    OdeContacts contacts(now.content.scene);
    return findFaceUp(now, contacts, face, [&](int tried) { told.push_back(tried); }, stop.get_token());
  }
  /// Simulated afresh: at rest, that face up, there.
  void expectUp(const FaceUpFound& found, const FaceUp& face) const {
    ASSERT_TRUE(found.content) << found.message;
    OdeContacts afresh(found.content->scene);
    const Motion motion = simulate(found.content->scene, afresh, document.duration);
    ASSERT_EQ(motion.status, MotionStatus::complete) << motion.message;
    const auto body = static_cast<std::size_t>(bodyIndex(found.content->scene, face.body));
    EXPECT_EQ(motion.world_lines[body].arcs.back().kind(), ArcKind::rest);
    const BodyState end = motion.stateAt(face.body, motion.end);
    EXPECT_GT((end.orientation * face.up).z(), 1 - 1e-9);
    if (face.place) EXPECT_TRUE((end.position.head<2>() - *face.place).norm() <= 1e-10) << (end.position.head<2>() - *face.place).norm();
  }
};

TEST_F(FacesUp, EverySideOfADieIsBroughtUpAtAPlaceByTheSameThrow) {
  const SessionSnapshot now = snapshot({});
  const Body& thrown = document.scene.bodies[1];
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      FaceUp face{0, "die", sign * Vec3::Unit(axis), Vec2(0.1 * axis, 0.05 * sign), axis == 2};
      told.clear();
      const FaceUpFound found = find(now, face);
      std::printf("axis %d, %g: %d tries before it\n", axis, sign, found.tried);
      expectUp(found, face);
      if (!found.content) continue;
      const Body& body = found.content->scene.bodies[1];
      if (found.tried == 0) EXPECT_EQ(body.velocity, thrown.velocity) << "the throw is the same";
      EXPECT_EQ(found.content->scene.bodies[0].position, document.scene.bodies[0].position);
      ASSERT_EQ(found.content->nails.size(), axis == 2 ? 1u : 0u);
    }
  }
}

TEST_F(FacesUp, WhereItsStartWouldOverlapAnotherItIsThrownOtherwise) {
  Body other = document.scene.bodies[1];
  other.name = "other", other.fixed = true, other.mass.reset();
  other.velocity = other.angular_velocity = Vec3::Zero();
  other.shape = Box{{0.01, 0.01, 0.01}};
  FaceUp face{0, "die", Vec3(0, 0, 1), Vec2(0.1, 0.1), false};
  const FaceUpFound free = find(snapshot({}), face);
  ASSERT_TRUE(free.content);
  other.position = free.content->scene.bodies[1].position;  // where it would start
  document.scene.bodies.push_back(other);
  const FaceUpFound found = find(snapshot({}), face);
  EXPECT_GT(found.tried, 0);
  expectUp(found, face);
}

TEST_F(FacesUp, ItsNailIsMet) {
  const FaceUp face{0, "die", Vec3(0, 1, 0), Vec2(0.2, -0.1), true};
  const FaceUpFound found = find(snapshot({}), face);
  ASSERT_TRUE(found.content);
  OdeContacts contacts(document.scene);
  EditSession session(document.scene, contacts, document.duration, {}, {});
  session.setContent(*found.content, "a face up");
  const std::vector<NailState> nails = session.nailStates();
  ASSERT_EQ(nails.size(), 1u);
  EXPECT_TRUE(nails[0].met) << nails[0].message << " " << nails[0].error;
}

TEST_F(FacesUp, WithinItsControlsByAnEdit) {
  const FaceUp face{0, "die", Vec3(0, 0, -1), std::nullopt, false};
  const FaceUpFound found = find(snapshot(document.controls), face);
  expectUp(found, face);
  ASSERT_TRUE(found.content);
  EXPECT_EQ(found.content->scene.bodies[1].position, document.scene.bodies[1].position) << "only the throw may change";
}

TEST_F(FacesUp, WhatCannotLieOnAFaceIsSaid) {
  document.duration = 0.1;  // it flies
  FaceUp face{0, "die", Vec3(0, 0, -1), std::nullopt, false};
  const FaceUpFound found = find(snapshot({}), face);
  EXPECT_FALSE(found.content);
  EXPECT_EQ(found.message, "No throw was found with which 'die' comes to rest with this face up.");
  EXPECT_EQ(told.size(), 400u);
  EXPECT_THROW(find(snapshot(document.controls), face), InputError) << "nothing says how high it would lie";
  face.body = "table";
  EXPECT_THROW(find(snapshot({}), face), InputError);
  face.body = "die";
  stop.request_stop();
  EXPECT_EQ(find(snapshot({}), face).message, "");
  document.scene.gravity = Vec3(0, -9.81, 0);
  EXPECT_THROW(find(snapshot({}), face), InputError);
}

struct FaceAsked : testing::Test, WorkerTest {};

TEST_F(FaceAsked, ItIsOneStepAndAHandEndsTheSearch) {
  hello(1);
  worker->step({});
  Json state = lastOf(received.take(1), "state");
  const auto until = [&](const Json& message) {
    send(1, message);
    worker->step({});
    std::vector<Json> all = received.take(1);
    while (lastOf(all, "face_up").is_null() || lastOf(all, "face_up").value("more", false)) {
      worker->step({});
      for (Json& one : received.take(1)) all.push_back(std::move(one));
    }
    return all;
  };
  const Json asked = {{"type", "face_up"}, {"rev", state["rev"]}, {"body", "ball"}, {"up", {0, 0, 1}}};
  const Json last = lastOf(until(asked), "face_up");  // a ball rests on no face
  EXPECT_FALSE(last["found"]) << last;
  EXPECT_FALSE(last["message"].get<std::string>().empty());
  EXPECT_EQ(lastOf(ask(1, {{"type", "face_up"}, {"rev", 99}, {"body", "ball"}, {"up", {0, 0, 1}}}), "error")["code"], "stale");
  EXPECT_EQ(lastOf(ask(1, {{"type", "face_up"}, {"rev", state["rev"]}, {"body", "none"}, {"up", {0, 0, 1}}}), "error")["code"], "input");
  EXPECT_THROW(send(1, {{"type", "face_up"}, {"rev", state["rev"]}, {"body", "ball"}, {"up", {0, 0, 0}}}), MessageError);
  send(1, asked);
  send(1, {{"type", "stop"}});  // before anything is found
  worker->step({});
  worker->step({});
  EXPECT_EQ(lastOf(received.take(1), "face_up")["cancelled"], true);
}

}  // namespace
}  // namespace carom::studio
