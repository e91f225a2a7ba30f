// SPDX-License-Identifier: MIT
#include "formats/answers/result_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace carom {

using namespace formats_detail;

namespace {

using nlohmann::json;

class NoGeometry : public ContactGeometry {
 public:
  ContactPoint contact(int, int, const FeaturePair&, const Pose&, const Pose&) const override { return {}; }
  ContactJacobian jacobian(int, int, const FeaturePair&, const Pose&, const Pose&) const override { return {}; }
  std::vector<ContactJacobian> jacobianRates(int, int, const FeaturePair&, const Pose&, const Pose&,
                                             std::span<const PairTangent> directions) const override {
    return std::vector<ContactJacobian>(directions.size());
  }
  std::string describe(int, int, const FeaturePair&) const override { return {}; }
};

/// A ball that falls past a floor, with events put in by hand: only the writing is under test.
Motion fallingBall() {
  auto scene = std::make_shared<Scene>();
  scene->bodies.resize(2);
  scene->bodies[0].name = "floor";
  scene->bodies[0].fixed = true;
  scene->bodies[0].shape = Plane{};
  scene->bodies[1].name = "the \"ball\"";
  scene->bodies[1].mass = 1;
  scene->bodies[1].position = {0.1, 0, 1.0 / 3};
  auto models = std::make_shared<std::vector<BodyModel>>();
  for (const Body& body : scene->bodies) models->push_back(modelOf(body));
  Motion motion;
  motion.scene = scene;
  motion.models = models;
  motion.geometry = std::make_shared<NoGeometry>();
  motion.plan = makePlan(*scene);
  motion.duration = 2;
  motion.end = 2;
  motion.message = "complete";
  for (std::size_t i = 0; i < 2; ++i) {
    const BodyModel& model = (*models)[i];
    Arc arc(model, motion.plan.bodies[i].tier, scene->gravity, 0, startState(scene->bodies[i], model));
    arc.extendTo(motion.end);
    motion.world_lines.push_back({{arc}, {}});
  }
  return motion;
}

Contact contactAt(const Vec3& point) {
  Contact contact;
  contact.a = 1;
  contact.b = 0;
  contact.at = {0, Vec3::UnitZ(), point};
  contact.pair = {0.1 + 0.2, 0.5, 0};
  return contact;
}

TEST(MotionJson, statesAtGivenTimesAndAtTheEnd) {
  const Motion motion = fallingBall();
  const json at_end = json::parse(motionJson(motion, {}));
  ASSERT_EQ(at_end["states"].size(), 1u);
  EXPECT_EQ(at_end["states"][0]["time"], 2);
  EXPECT_EQ(at_end["status"], "complete");
  EXPECT_EQ(at_end["end"], 2);

  const json twice = json::parse(motionJson(motion, {0, 0.5}));
  ASSERT_EQ(twice["states"].size(), 2u);
  const json& ball = twice["states"][1]["bodies"]["the \"ball\""];
  const BodyState state = motion.stateAt(1, 0.5);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(ball["position"][i].get<double>(), state.position[static_cast<int>(i)]);
    EXPECT_EQ(ball["velocity"][i].get<double>(), state.velocity[static_cast<int>(i)]);
  }
  EXPECT_EQ(ball["orientation"], json({1, 0, 0, 0}));
  EXPECT_EQ(twice["states"][0]["bodies"]["the \"ball\""]["position"], json({0.1, 0, 1.0 / 3}));
  EXPECT_EQ(twice["states"][0]["bodies"]["floor"]["position"], json({0, 0, 0}));
  EXPECT_THROW(motionJson(motion, {3}), std::exception);
}

TEST(MotionJson, events) {
  Motion motion = fallingBall();
  Event single;
  single.time = 0.25;
  single.mode = ImpactMode::slide;
  single.contacts = {contactAt({1, 2, 0})};
  single.margins = {0.75, 0.25};
  Event joint = single;
  joint.time = 0.5;
  joint.mode = ImpactMode::joint;
  joint.contacts.push_back(contactAt({3, 4, 0}));
  motion.events = {single, joint};

  const json answer = json::parse(motionJson(motion, {}));
  ASSERT_EQ(answer["events"].size(), 2u);
  const json& first = answer["events"][0];
  EXPECT_EQ(first["time"], 0.25);
  EXPECT_EQ(first["bodies"], json({"the \"ball\"", "floor"}));
  EXPECT_EQ(first["point"], json({1, 2, 0}));
  EXPECT_EQ(first["normal"], json({0, 0, 1}));
  EXPECT_EQ(first["mode"], "slide");
  EXPECT_EQ(first["elasticity"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(first["margin"], 0.25);
  EXPECT_EQ(first["margins"], json({{"grazing", 0.75}, {"stick_slip", 0.25}}));
  EXPECT_FALSE(first.contains("contacts"));
  ASSERT_EQ(answer["events"][1]["contacts"].size(), 2u);
  EXPECT_EQ(answer["events"][1]["mode"], "joint");
  EXPECT_EQ(answer["events"][1]["contacts"][1]["point"], json({3, 4, 0}));
}

TEST(MotionJson, aTransitionHasACauseAndNoLaw) {
  Motion motion = fallingBall();
  Event impact;
  impact.contacts = {contactAt({1, 2, 0})};
  impact.participants = {{1, 0, 1, {}}};
  Event transition = impact;
  transition.kind = EventKind::transition;
  transition.cause = TransitionCause::leaves;
  transition.participants[0].impact = 0;
  Event capture = impact;
  capture.kind = EventKind::capture;
  capture.settles_at = 0.1 + 0.2;
  motion.events = {impact, transition, capture};
  const json events = json::parse(motionJson(motion, {}))["events"];
  const std::string kinds[] = {"impact", "transition", "capture"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(events[i]["kind"], kinds[i]);
    EXPECT_EQ(events[i]["counts"], i != 1);
    EXPECT_EQ(events[i].contains("cause"), i == 1);
    EXPECT_EQ(events[i].contains("settles_at"), i == 2);
    for (const char* of_the_law : {"mode", "margin", "margins"}) EXPECT_EQ(events[i].contains(of_the_law), i != 1);
  }
  EXPECT_EQ(events[1]["cause"], "leaves");
  EXPECT_EQ(events[2]["settles_at"].get<double>(), 0.1 + 0.2);
}

TEST(MotionJson, numbersThatAreNotFiniteAreNull) {
  Motion motion = fallingBall();
  Event event;
  event.contacts = {contactAt({std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0})};
  event.margins.grazing = std::numeric_limits<double>::quiet_NaN();
  motion.events = {event};
  const json answer = json::parse(motionJson(motion, {}));
  EXPECT_EQ(answer["events"][0]["point"], json({nullptr, nullptr, 0}));
  EXPECT_EQ(answer["events"][0]["margins"]["grazing"], nullptr);
}

}  // namespace
}  // namespace carom
