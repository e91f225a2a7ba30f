// SPDX-License-Identifier: MIT
// What gestures hold and free, and that nothing of one scene is left to the next.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

struct WorkerGestures : testing::Test, WorkerTest {
  void SetUp() override {
    hello(1);
    worker->step({});
    received.take(1);
  }
};

TEST_F(WorkerGestures, NothingOfASceneIsLeftToTheNext) {
  hello(2);
  worker->step({});
  const Json first = lastOf(received.take(2), "scene");
  EXPECT_EQ(first["scene"], 1);
  folder.write("again.json", kTestScene);
  for (int k = 2; k <= 4; ++k) {
    const std::vector<Json> got = ask(1, {{"type", "open"}, {"path", k % 2 ? "bounce.json" : "again.json"}});
    for (const std::vector<Json>& page : {got, received.take(2)}) {
      const Json scene = lastOf(page, "scene"), motion = lastOf(page, "motion");
      ASSERT_FALSE(scene.is_null() || motion.is_null());
      EXPECT_EQ(scene["scene"], k);
      EXPECT_EQ(motion["scene"], k);
      EXPECT_EQ(scene["bodies"].size(), 3u) << "though they look like those before";
      EXPECT_EQ(motion["tracks"].size(), 3u) << "though they move like those before";
    }
  }
}

TEST_F(WorkerGestures, WhatNothingMovesIsFreed) {
  Json grab = kGrab;
  grab["free"] = true;
  std::vector<Json> got = ask(1, grab);
  EXPECT_FALSE(lastOf(got, "motion").contains("freed")) << "its velocity varies";
  EXPECT_EQ(lastOf(got, "state")["controls"].size(), 1u);
  ask(1, {{"type", "cancel"}, {"gesture", 1}});
  grab["body"] = "other", grab["gesture"] = 2, grab["at"] = 0.6;
  got = ask(1, grab);
  EXPECT_EQ(lastOf(got, "motion")["freed"], true) << "both met the floor, which moves nothing on";
  EXPECT_EQ(lastOf(got, "state")["controls"].size(), 3u);
  ask(1, {{"type", "cancel"}, {"gesture", 2}});
  grab["also_vary"] = Json::array({{{"vary", "velocity"}, {"body", "other"}}}), grab["id"] = 1000;
  EXPECT_THROW(readCommand(grab.dump()), MessageError) << "either the client says what varies, or it asks";
}

TEST_F(WorkerGestures, AnImpactIsHeldByItsContact) {
  const Json grab = {{"type", "grab"},
                     {"gesture", 1},
                     {"body", "ball"},
                     {"at", {{"impact", 1}, {"with", "floor"}}},
                     {"grip", {{"contact", true}, {"components", {"x", "y"}}}}};
  ask(1, grab);
  for (int seq = 1; seq <= 4; ++seq) {
    const double x = 0.8 + 0.1 * seq, y = 0.05 * seq;
    const Json motion = lastOf(
        ask(1, {{"type", "drag"}, {"gesture", 1}, {"seq", seq}, {"place", {x, y, 7}}}), "motion");
    EXPECT_TRUE(motion["reached"]);
    const Json impacts = motion["impacts"];
    const auto of_ball = [](const Json& impact) { return impact["bodies"] == Json{0, 1}; };
    const Json point = (*std::find_if(impacts.begin(), impacts.end(), of_ball))["point"];
    EXPECT_TRUE(std::abs(point[0].get<double>() - x) <= 1e-9 && std::abs(point[1].get<double>() - y) <= 1e-9) << point;
    EXPECT_TRUE(std::abs(point[2].get<double>()) <= 1e-9) << "where it is in height, the floor says";
  }
  ask(1, {{"type", "cancel"}, {"gesture", 1}});
  Json none = grab;
  none["gesture"] = 2, none["at"]["impact"] = 9;
  EXPECT_EQ(lastOf(ask(1, none), "error")["code"], "input");
}

TEST(WorkerExamples, OpenAsCopiesThatAreNotSaved) {
  TestFolder place;
  place.write("bounce.json", kTestScene);
  WorkerTest test("", solvingWithoutClock(), place.path());
  test.workspace = std::make_unique<Workspace>(place.path());
  WorkerOptions options;
  options.solving = solvingWithoutClock();
  options.gallery = place.path();
  test.worker = std::make_unique<Worker>(
      test.mailbox, *test.workspace,
      Post{[&](SocketId to, const Outgoing& message) { test.received.add(to, message); }}, options);
  test.worker->openFirst("bounce.json");
  test.hello(1);
  test.worker->step({});
  const Json state = lastOf(test.received.take(1), "state");
  EXPECT_TRUE(state["path"].is_null());
  EXPECT_EQ(state["suggested"], "bounce-copy.json");
  EXPECT_FALSE(state["saved"]);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "save"}}), "error")["code"], "input") << "it has to be given a name";
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "open"}, {"path", "bounce.json"}}), "state")["path"], nullptr);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "save"}, {"path", "bounce-copy.json"}}), "saved")["path"], "bounce-copy.json");
  EXPECT_EQ(place.read("bounce.json"), kTestScene);
}

}  // namespace
}  // namespace carom::studio
