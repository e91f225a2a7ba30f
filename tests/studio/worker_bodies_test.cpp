// SPDX-License-Identifier: MIT
// Scenes that begin empty, bodies that come, go, are copied and renamed, and numbers that are tried.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

struct Bodies : testing::Test, WorkerTest {
  void SetUp() override {
    hello(1);
    worker->step({});
    state = lastOf(received.take(1), "state");
  }
  /// With the revision that is known; keeps the state that comes.
  std::vector<Json> say(Json message) {
    if (message["type"] != "nail" && message["type"] != "undo") message["rev"] = state["rev"];
    const std::vector<Json> got = ask(1, message);
    if (const Json next = lastOf(got, "state"); !next.is_null()) state = next;
    return got;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Json& body : state["bodies"]) all.push_back(body["name"]);
    return all;
  }
  static Json ball() { return {{"name", "ball"}, {"shape", {{"sphere", {{"radius", 0.1}}}}}, {"density", 600}, {"material", "felt"}}; }
  static Json onFloor(double x, double y) { return {{"point", {x, y, 0}}, {"normal", {0, 0, 1}}}; }
  Json state;
};

using Names = std::vector<std::string>;

TEST_F(Bodies, ABodyIsAddedWhereItTouches) {
  const std::vector<Json> got = say({{"type", "add_body"}, {"body", ball()}, {"on", onFloor(2, 1)}});
  EXPECT_EQ(names(), (Names{"floor", "ball", "other", "ball 2"})) << "its name is free";
  EXPECT_EQ(state["bodies"][3]["position"], Json({2, 1, 0.1}));
  EXPECT_EQ(lastOf(got, "motion")["count"], 4);
  EXPECT_EQ(lastOf(got, "scene")["count"], 4);
  EXPECT_EQ(state["undo"], "another body");
  say({{"type", "add_body"}, {"body", {{"name", "box"}, {"shape", {{"box", {{"size", {0.2, 0.2, 0.4}}}}}}, {"mass", 1}}}, {"on", onFloor(3, 1)}});
  EXPECT_EQ(state["bodies"][4]["position"], Json({3, 1, 0.2}));
  EXPECT_EQ(lastOf(ask(1, {{"type", "undo"}}), "state")["bodies"].size(), 4u);
  EXPECT_EQ(lastOf(ask(1, {{"type", "undo"}}), "state")["bodies"].size(), 3u);
}

TEST_F(Bodies, WhatStandsOnWhatWasAddedRests) {
  for (int k = 0; k < 3; ++k) {
    Json box = {{"name", "box " + std::to_string(k)}, {"shape", {{"box", {{"size", {0.2, 0.2, 0.1}}}}}}, {"material", "felt"}};
    if (k < 2) box["fixed"] = true;
    if (k == 2) box["mass"] = 1;
    say({{"type", "add_body"}, {"body", box}, {"on", {{"point", {2, 1, 0.1 * k}}, {"normal", {0, 0, 1}}}}});
  }
  ASSERT_EQ(names().size(), 6u);
  const Json motion = lastOf(ask(1, {{"type", "stop"}}), "motion");
  EXPECT_EQ(motion["status"], "complete") << motion["message"];
  for (const Json& impact : motion["impacts"]) EXPECT_TRUE(std::find(impact["bodies"].begin(), impact["bodies"].end(), 5) == impact["bodies"].end()) << "it does not even bounce";
}

TEST_F(Bodies, WhatOverlapsIsNamedAndRefusedWholeWithAFreePlace) {
  const Json before = state;
  const Json error = lastOf(say({{"type", "add_body"}, {"body", ball()}, {"on", onFloor(0.0, 0.0)}}), "error");
  EXPECT_TRUE(error.is_null()) << "below the ball that is thrown there is room: " << error;
  const Json refused = lastOf(say({{"type", "add_body"}, {"body", ball()}, {"on", onFloor(0.12, 0.0)}}), "error");
  ASSERT_EQ(refused["code"], "overlap") << refused;
  EXPECT_EQ(refused["message"], "'ball 3' would overlap 'ball 2' by 80 mm at the start.");
  EXPECT_EQ(names().size(), 4u);
  const Json place = refused["place"];
  ASSERT_EQ(place.size(), 3u);
  EXPECT_TRUE(std::abs(place[0].get<double>() - 0.2) <= 1e-3 && place[1] == 0.0) << place;
  Json there = ball();
  there["position"] = place;
  say({{"type", "add_body"}, {"body", there}});
  EXPECT_EQ(names().back(), "ball 3");
  const Json typed = lastOf(say({{"type", "set"}, {"edits", {{{"pointer", "/bodies/4/position"}, {"value", {0.05, 0, 0.1}}}}}}), "error");
  EXPECT_EQ(typed["code"], "overlap");
  EXPECT_EQ(typed["body"], "ball 3");
}

TEST(ManyBodies, TheFreePlaceIsFoundAmongHundreds) {
  Json scene = Json::parse(kTestScene);
  scene["controls"] = Json::array();
  constexpr int kSide = 20;
  for (int i = 0; i < kSide * kSide; ++i)
    scene["bodies"].push_back({{"name", "pebble " + std::to_string(i + 2)}, {"fixed", true}, {"shape", {{"sphere", {{"radius", 0.1}}}}},
                               {"position", {10 + 0.21 * (i % kSide), 0.21 * (i / kSide), 0.1}}});
  WorkerTest test(scene.dump());
  test.hello(1);
  test.worker->step({});
  const Json rev = lastOf(test.received.take(1), "state")["rev"];
  const double x = 10 + 0.21 * 10 + 0.03, y = 0.21 * 10;
  const Json added = {{"name", "ball"}, {"shape", {{"sphere", {{"radius", 0.1}}}}}, {"density", 600}, {"position", {x, y, 0.1}}};
  const Json place = lastOf(test.ask(1, {{"type", "add_body"}, {"rev", rev}, {"body", added}}), "error")["place"];
  ASSERT_EQ(place.size(), 3u);
  // on top of the pebble that it is in: the others of the layer are farther, and the floor is below
  const double up = std::sqrt(0.2 * 0.2 - 0.03 * 0.03);
  EXPECT_EQ(place[0], x);
  EXPECT_EQ(place[1], y);
  EXPECT_TRUE(place[2] >= 0.1 + up - 1e-9 && place[2] <= 0.1 + up + 1e-3) << place;
}

TEST_F(Bodies, ABodyGoesWithWhatNamesIt) {
  say({{"type", "nail"}, {"body", "ball"}, {"at", 0.3}});
  ASSERT_EQ(state["nails"].size(), 1u);
  say({{"type", "remove_body"}, {"body", "ball"}});
  EXPECT_EQ(names(), (Names{"floor", "other"}));
  EXPECT_EQ(state["nails"].size() + state["controls"].size(), 0u);
  say({{"type", "undo"}});
  EXPECT_EQ(names(), (Names{"floor", "ball", "other"}));
  EXPECT_EQ(state["nails"].size(), 1u);
  EXPECT_EQ(state["controls"].size(), 1u);
  EXPECT_EQ(lastOf(say({{"type", "remove_body"}, {"body", "nobody"}}), "error")["code"], "input");
}

TEST_F(Bodies, ABodyIsCopiedBesideItself) {
  for (int k = 0; k < 4; ++k) say({{"type", "copy_body"}, {"body", "other"}});
  EXPECT_EQ(names(), (Names{"floor", "ball", "other", "other 2", "other 3", "other 4", "other 5"}));
  EXPECT_EQ(state["bodies"][3]["mass"], state["bodies"][2]["mass"]);
  EXPECT_EQ(state["bodies"][3]["position"][2], state["bodies"][2]["position"][2]);
  EXPECT_EQ(lastOf(say({{"type", "copy_body"}, {"body", "floor"}}), "error")["code"], "input") << "a plane has no end";
}

TEST_F(Bodies, ANameIsChangedWhereverItStands) {
  say({{"type", "nail"}, {"constraint", {{"body", "ball"}, {"at", {{"impact", 1}, {"with", "floor"}}}, {"position", {0.6, nullptr, nullptr}}}}});
  say({{"type", "rename_body"}, {"body", "ball"}, {"name", "a ball"}});
  say({{"type", "rename_body"}, {"body", "floor"}, {"name", "ground"}});
  EXPECT_EQ(names(), (Names{"ground", "a ball", "other"}));
  EXPECT_EQ(state["controls"][0]["body"], "a ball");
  const Json constraint = state["nails"][0]["constraint"];
  EXPECT_EQ(constraint["body"], "a ball");
  EXPECT_EQ(constraint["at"]["with"], "ground");
  EXPECT_EQ(lastOf(say({{"type", "rename_body"}, {"body", "ground"}, {"name", "other"}}), "error")["code"], "input") << "taken";
}

TEST_F(Bodies, NumbersAreTriedAndNotKept) {
  const Json edits = {{{"pointer", "/bodies/1/position"}, {"value", {0, 1, 2}}}};
  const Json rev = state["rev"];
  const Json shown = lastOf(say({{"type", "try"}, {"gesture", 7}, {"seq", 3}, {"edits", edits}}), "motion");
  EXPECT_EQ(shown["gesture"], 7);
  EXPECT_EQ(shown["seq"], 3);
  EXPECT_EQ(shown["rev"], rev);
  const std::vector<Json> back = ask(1, {{"type", "stop"}});
  EXPECT_EQ(lastOf(back, "state")["rev"], rev);
  EXPECT_EQ(lastOf(back, "state")["bodies"][1]["position"], Json({0, 0, 1}));
  EXPECT_FALSE(lastOf(back, "motion").is_null());
  EXPECT_EQ(lastOf(say({{"type", "try"}, {"gesture", 7}, {"seq", 4}, {"edits", {{{"pointer", "/bodies/1/position"}, {"value", {0, 0, -1}}}}}}), "error")["code"], "overlap");
  EXPECT_TRUE(state["undo"].is_null());
}

TEST(NewScene, HasAFloorAndNoFile) {
  WorkerTest test("");
  test.hello(1);
  test.worker->step({});
  std::vector<Json> got = test.ask(1, {{"type", "new"}});
  Json state = lastOf(got, "state");
  EXPECT_EQ(state["bodies"].size(), 1u);
  EXPECT_TRUE(state["path"].is_null());
  EXPECT_EQ(state["suggested"], "scene.json");
  EXPECT_EQ(lastOf(got, "motion")["status"], "complete");
  Json ball = Bodies::ball();
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "add_body"}, {"rev", state["rev"]}, {"body", ball}}), "error")["code"], "input") << "no such material";
  ball["material"] = "wood";
  got = test.ask(1, {{"type", "add_body"}, {"rev", state["rev"]}, {"body", ball}, {"on", Bodies::onFloor(0, 0)}});
  EXPECT_EQ(lastOf(got, "state")["bodies"].size(), 2u) << lastOf(got, "error");
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "new"}}), "error")["code"], "conflict");
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "save"}, {"path", "scene.json"}}), "saved")["path"], "scene.json");
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "new"}}), "state")["suggested"], "scene-2.json");
}

}  // namespace
}  // namespace carom::studio
