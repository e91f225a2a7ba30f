// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "formats/documents/scene_json.h"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

struct Workers : testing::Test, WorkerTest {
  void SetUp() override {
    hello(1);
    worker->step({});
  }
};

TEST_F(Workers, AHelloGetsAllThereIs) {
  const std::vector<Json> got = received.take(1);
  ASSERT_EQ(got.size(), 4u);
  EXPECT_EQ(got[0]["type"], "welcome");
  EXPECT_EQ(got[0]["folder"], folder.path());
  EXPECT_EQ(got[1]["type"], "scene");
  EXPECT_EQ(got[1]["bodies"].size(), 3u);
  EXPECT_EQ(got[2]["type"], "motion");
  EXPECT_EQ(got[2]["tracks"].size(), 3u);
  EXPECT_EQ(got[3]["type"], "state");
  for (const Json& message : got) EXPECT_EQ(message["re"], 1) << message["type"];
  const Json& state = got[3];
  EXPECT_EQ(state["path"], "bounce.json");
  EXPECT_EQ(state["name"], "A bounce");
  EXPECT_TRUE(state["saved"]);
  EXPECT_TRUE(state["undo"].is_null() && state["redo"].is_null() && state["held_by"].is_null());
  EXPECT_EQ(state["bodies"][1]["name"], "ball");
  EXPECT_EQ(state["bodies"][1]["mass"], 0.2);
  EXPECT_TRUE(state["bodies"][0]["mass"].is_null());
  ASSERT_EQ(state["numbers"].size(), 3u);
  EXPECT_EQ(state["numbers"][0]["pointer"], "/bodies/1/velocity/0");
  EXPECT_EQ(state["numbers"][0]["opened"], 1.5);
  EXPECT_EQ(state["numbers"][0]["now"], 1.5);
  EXPECT_EQ(state["numbers"][2]["max"], 20);
}

TEST_F(Workers, ADragMovesAndItsReleaseIsOneStep) {
  const Json held = lastOf(ask(1, kGrab), "state");
  EXPECT_EQ(held["held_by"], "tab1");
  const Json moved = lastOf(ask(1, dragTo(5, 0.6, 1.0)), "motion");
  EXPECT_EQ(moved["gesture"], 1);
  EXPECT_EQ(moved["seq"], 5);
  EXPECT_TRUE(moved["reached"]);
  EXPECT_FALSE(moved["more"]);
  EXPECT_LE(moved["distance"].get<double>(), 1e-6);
  EXPECT_EQ(moved["tracks"].size(), 1u) << "those of the others are there already";
  const std::vector<Json> end = ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 6}, {"place", {0.6, 0, 1.1}}});
  EXPECT_EQ(lastOf(end, "motion")["re"], id);
  const Json state = lastOf(end, "state");
  EXPECT_EQ(state["re"], id);
  EXPECT_FALSE(state["saved"]);
  EXPECT_TRUE(state["held_by"].is_null());
  EXPECT_FALSE(state["undo"].is_null());
  EXPECT_NE(state["numbers"][0]["now"], 1.5);
  EXPECT_EQ(state["numbers"][0]["opened"], 1.5);
  const Json back = lastOf(ask(1, {{"type", "undo"}}), "state");
  EXPECT_TRUE(back["saved"]);
  EXPECT_TRUE(back["undo"].is_null());
  EXPECT_FALSE(back["redo"].is_null());
  EXPECT_EQ(back["numbers"][0]["now"], 1.5);
  EXPECT_NE(lastOf(ask(1, {{"type", "redo"}}), "state")["numbers"][0]["now"], 1.5);
}

TEST_F(Workers, OnlyTheNewestOfManyDragsIsDone) {
  ask(1, kGrab);
  for (int seq = 1; seq <= 40; ++seq) send(1, dragTo(seq, 0.45 + 0.005 * seq, 1));
  received.take(1);
  worker->step({});
  const std::vector<Json> got = received.take(1);
  EXPECT_EQ(lastOf(got, "motion")["seq"], 40);
  EXPECT_TRUE(mailbox.isEmpty());
}

TEST_F(Workers, ACancelPutsEverythingBack) {
  ask(1, kGrab);
  ask(1, dragTo(1, 0.9, 1.2));
  const std::vector<Json> got = ask(1, {{"type", "cancel"}, {"gesture", 1}});
  EXPECT_EQ(lastOf(got, "state")["numbers"][0]["now"], 1.5);
  EXPECT_TRUE(lastOf(got, "state")["saved"]);
  EXPECT_EQ(lastOf(ask(1, dragTo(2, 1, 1)), "error")["code"], "not_held");
  EXPECT_EQ(lastOf(ask(1, {{"type", "cancel"}, {"gesture", 1}}), "error")["code"], "not_held");
}

TEST_F(Workers, AnotherPageSeesTheMotionAndHasToWait) {
  hello(2);
  worker->step({});
  received.take(2);
  ask(1, kGrab);
  EXPECT_EQ(lastOf(received.take(2), "state")["held_by"], "tab1");
  ask(1, dragTo(1, 0.6, 1));
  const Json seen = lastOf(received.take(2), "motion");
  EXPECT_EQ(seen["tracks"].size(), 1u);
  EXPECT_FALSE(seen.contains("re"));
  Json second = kGrab;
  second["gesture"] = 7;
  EXPECT_EQ(lastOf(ask(2, second), "error")["code"], "busy");
  EXPECT_EQ(lastOf(ask(2, {{"type", "undo"}}), "error")["code"], "busy");
  EXPECT_EQ(lastOf(ask(2, {{"type", "open"}, {"path", "bounce.json"}, {"replace", true}}), "error")["code"], "busy");
  EXPECT_EQ(lastOf(ask(2, dragTo(2, 0.7, 1)), "error")["code"], "not_held");
  ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 2}});
  EXPECT_FALSE(lastOf(ask(2, second), "state").is_null());
}

TEST_F(Workers, ThePageThatHoldsGoesAway) {
  hello(2);
  worker->step({});
  ask(1, kGrab);
  ask(1, dragTo(1, 0.9, 1));
  received.take(2);
  mailbox.put({1, {0, Gone{}}});
  worker->step({});
  const std::vector<Json> got = received.take(2);
  EXPECT_TRUE(lastOf(got, "state")["held_by"].is_null());
  EXPECT_EQ(lastOf(got, "state")["numbers"][0]["now"], 1.5);
  EXPECT_TRUE(received.take(1).empty());
}

TEST_F(Workers, NumbersAreTypedAndRefusedWithTheirPlace) {
  const std::int64_t rev = lastOf(received.take(1), "state")["rev"];
  const auto set = [&](const char* pointer, const Json& value, std::int64_t of) {
    return ask(1, {{"type", "set"}, {"rev", of}, {"edits", {{{"pointer", pointer}, {"value", value}}}}});
  };
  const std::vector<Json> good = set("/bodies/1/velocity/0", 2.5, rev);
  EXPECT_EQ(lastOf(good, "state")["numbers"][0]["now"], 2.5);
  EXPECT_EQ(lastOf(good, "state")["undo"], "velocity of 'ball'");
  EXPECT_EQ(lastOf(set("/bodies/1/velocity/0", 3, rev), "error")["code"], "stale");
  const std::int64_t next = lastOf(good, "state")["rev"];
  EXPECT_GT(next, rev);
  const Json wrong = lastOf(set("/bodies/1/velocity/0", nullptr, next), "error");
  EXPECT_EQ(wrong["code"], "input");
  EXPECT_EQ(wrong["pointer"], "/bodies/1/velocity/0");
  EXPECT_NE(wrong["message"].get<std::string>().find("expected a number"), std::string::npos);
  for (const char* place : {"/bodies/9/velocity/0", "/bodies/1/velocity/7", "/nothing/at/all", "/", "/controls/0/max",
                            "/bodies/x", "/bodies/1/unknown", "/carom"})
    EXPECT_EQ(lastOf(set(place, 2, next), "error")["code"], "input") << place;
  EXPECT_EQ(lastOf(set("/bodies/2/velocity/1", 0.5, next), "error"), nullptr) << "a vector that was left out";
  EXPECT_EQ(lastOf(ask(1, {{"type", "undo"}}), "state")["numbers"][0]["now"], 2.5);
  EXPECT_TRUE(lastOf(ask(1, {{"type", "undo"}}), "state")["saved"]);
}

TEST_F(Workers, UndoneBytesAreTheBytesThatWereOpened) {
  ask(1, kGrab);
  ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 1}, {"place", {0.7, 0, 1.1}}});
  EXPECT_EQ(lastOf(ask(1, {{"type", "save"}}), "saved")["path"], "bounce.json");
  EXPECT_NE(folder.read("bounce.json"), kTestScene);
  const Document saved = readDocument((folder / "bounce.json").string());
  EXPECT_NE(saved.scene.bodies[1].velocity.x(), 1.5);

  WorkerTest other;
  other.hello(1);
  other.worker->step({});
  other.ask(1, kGrab);
  other.ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 1}, {"place", {0.7, 0, 1.1}}});
  other.ask(1, {{"type", "undo"}});
  EXPECT_EQ(lastOf(other.ask(1, {{"type", "save"}}), "saved")["path"], "bounce.json");
  EXPECT_EQ(other.folder.read("bounce.json"), kTestScene);
}

TEST_F(Workers, ASaveInAGestureWaitsForItsEnd) {
  ask(1, kGrab);
  EXPECT_EQ(lastOf(ask(1, {{"type", "save"}}), "saved"), nullptr);
  EXPECT_EQ(folder.read("bounce.json"), kTestScene);
  const std::vector<Json> end = ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 1}, {"place", {0.7, 0, 1}}});
  EXPECT_EQ(lastOf(end, "saved")["path"], "bounce.json");
  EXPECT_TRUE(lastOf(end, "state")["saved"]);
}

TEST_F(Workers, AChangedFileIsAConflictWithTwoWaysOut) {
  ask(1, kGrab);
  ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 1}, {"place", {0.7, 0, 1}}});
  folder.write("bounce.json", std::string(kTestScene) + "\n");
  EXPECT_EQ(lastOf(ask(1, {{"type", "save"}}), "error")["code"], "conflict");
  EXPECT_EQ(folder.read("bounce.json"), std::string(kTestScene) + "\n");
  EXPECT_EQ(lastOf(ask(1, {{"type", "open"}, {"path", "bounce.json"}}), "error")["code"], "conflict") << "unsaved";
  EXPECT_EQ(lastOf(ask(1, {{"type", "save"}, {"path", "copy.json"}}), "saved")["path"], "copy.json");
  const std::vector<Json> opened = ask(1, {{"type", "open"}, {"path", "bounce.json"}});
  EXPECT_EQ(lastOf(opened, "state")["path"], "bounce.json");
  EXPECT_FALSE(lastOf(opened, "scene").is_null());
  EXPECT_FALSE(lastOf(opened, "motion").is_null());
}

TEST_F(Workers, ListsAndRefusesNames) {
  const Json files = lastOf(ask(1, {{"type", "list"}}), "files");
  ASSERT_EQ(files["files"].size(), 1u);
  EXPECT_EQ(files["files"][0]["path"], "bounce.json");
  EXPECT_EQ(lastOf(ask(1, {{"type", "list"}, {"path", ".."}}), "error")["code"], "input");
  EXPECT_EQ(lastOf(ask(1, {{"type", "open"}, {"path", "../x.json"}}), "error")["code"], "input");
  EXPECT_EQ(lastOf(ask(1, {{"type", "gallery"}}), "gallery")["scenes"].size(), 0u);
  folder.write("broken.json", R"({"carom": 1, "bodies": [{"name": "a", "shape": {"sphere": {"radius": -1}}}]})");
  const Json broken = lastOf(ask(1, {{"type", "open"}, {"path", "broken.json"}}), "error");
  EXPECT_EQ(broken["pointer"], "/bodies/0/shape/sphere/radius");
  EXPECT_EQ(broken["file"], "broken.json");
  EXPECT_FALSE(lastOf(ask(1, kGrab), "state").is_null()) << "what was open is open still";
}

TEST_F(Workers, NailsAreMadeMovedSwitchedAndRemoved) {
  const auto nailsOf = [](const std::vector<Json>& got) { return lastOf(got, "state")["nails"]; };
  Json nails = nailsOf(ask(1, {{"type", "nail"}, {"body", "ball"}, {"at", 0.3}}));
  ASSERT_EQ(nails.size(), 1u);
  EXPECT_TRUE(nails[0]["met"] && nails[0]["on"] && nails[0]["available"]);
  EXPECT_EQ(nails[0]["constraint"]["body"], "ball");
  const int nail = nails[0]["id"];
  EXPECT_FALSE(nailsOf(ask(1, {{"type", "nail_on"}, {"nail", nail}, {"on", false}}))[0]["on"]);
  const Json constraint = {{"body", "ball"}, {"at", 0.3}, {"position", {0.6, nullptr, nullptr}}};
  nails = nailsOf(ask(1, {{"type", "set_nail"}, {"nail", nail}, {"constraint", constraint}}));
  EXPECT_EQ(nails[0]["constraint"]["position"], (Json{0.6, nullptr, nullptr}));
  EXPECT_FALSE(nails[0]["met"]);
  EXPECT_TRUE(nailsOf(ask(1, {{"type", "meet_nails"}}))[0]["met"]);
  const Json wrong = lastOf(ask(1, {{"type", "nail"}, {"constraint", {{"body", "bal"}, {"at", 0}}}}), "error");
  EXPECT_EQ(wrong["pointer"], "/constraint/body");
  EXPECT_EQ(nailsOf(ask(1, {{"type", "unnail"}, {"nail", nail}})).size(), 0u);
  EXPECT_EQ(lastOf(ask(1, {{"type", "unnail"}, {"nail", nail}}), "error")["code"], "input");
}

TEST_F(Workers, ControlsAreSetAndAlsoVary) {
  Json grab = kGrab;
  grab["body"] = "other";
  grab["also_vary"] = {{{"vary", "velocity"}, {"body", "other"}, {"weight", 0.2}}};
  const Json held = lastOf(ask(1, grab), "state");
  EXPECT_EQ(held["controls"].size(), 2u);
  const Json moved = lastOf(ask(1, {{"type", "drag"}, {"gesture", 1}, {"seq", 1}, {"place", {0.2, 3, 0.8}}}), "motion");
  EXPECT_TRUE(moved["reached"]);
  ask(1, {{"type", "release"}, {"gesture", 1}, {"seq", 2}});
  const Json back = lastOf(ask(1, {{"type", "undo"}}), "state");
  EXPECT_EQ(back["controls"].size(), 1u);
  EXPECT_TRUE(back["saved"]);
  const Json controls = {{{"vary", "velocity"}, {"body", "other"}}};
  const Json now = lastOf(ask(1, {{"type", "controls"}, {"rev", back["rev"]}, {"controls", controls}}), "state");
  EXPECT_EQ(now["controls"][0]["body"], "other");
  EXPECT_EQ(lastOf(ask(1, {{"type", "controls"}, {"rev", back["rev"]}, {"controls", controls}}), "error")["code"],
            "stale");
}

}  // namespace
}  // namespace carom::studio
