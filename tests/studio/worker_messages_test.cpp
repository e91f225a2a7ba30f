// SPDX-License-Identifier: MIT
// What pages ask for besides drags, and what is answered where that makes no sense.
#include <gtest/gtest.h>

#include "formats/base/read_file.hpp"
#include "formats/documents/scene_json.h"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

const Json kRelease = {{"type", "release"}, {"gesture", 1}, {"seq", 1}, {"place", {0.7, 0, 1.1}}};
const Json kConstraint = {{"body", "ball"}, {"at", 0.3}, {"position", {0.6, nullptr, nullptr}}};

struct Messages : testing::Test, WorkerTest {
  void SetUp() override {
    hello(1);
    worker->step({});
  }
  Json stateAfter(const Json& message) { return lastOf(ask(1, message), "state"); }
  std::string codeOf(const Json& message) {
    const Json error = lastOf(ask(1, message), "error");
    return error.is_null() ? "" : error["code"].get<std::string>();
  }
};

TEST_F(Messages, AReleaseNailsWhereTheBodyGotTo) {
  ask(1, kGrab);
  Json release = kRelease;
  release["nail"] = true;
  const std::vector<Json> end = ask(1, release);
  const Json nails = lastOf(end, "state")["nails"];
  ASSERT_EQ(nails.size(), 1u);
  EXPECT_TRUE(nails[0]["met"]);
  EXPECT_TRUE(std::abs(nails[0]["constraint"]["position"][0].get<double>() - 0.7) <= 1e-6) << nails;
  EXPECT_EQ(stateAfter({{"type", "undo"}})["nails"].size(), 0u) << "drag and nail are one step";

  ask(1, kGrab);
  release["place"] = {300, 0, 1};
  const Json far = stateAfter(release)["nails"];
  ASSERT_EQ(far.size(), 1u);
  EXPECT_TRUE(far[0]["met"]) << far;
  EXPECT_TRUE(far[0]["constraint"]["position"][0].get<double>() < 100) << "never where it did not get to";
}

TEST_F(Messages, ANailIsTakenHoldOfAndMoved) {
  const int nail = stateAfter({{"type", "nail"}, {"constraint", kConstraint}})["nails"][0]["id"];
  const Json grab = {{"type", "grab_nail"}, {"gesture", 4}, {"nail", nail}};
  EXPECT_EQ(stateAfter(grab)["held_by"], "tab1");
  const Json moved = lastOf(ask(1, {{"type", "drag"}, {"gesture", 4}, {"seq", 1}, {"place", {0.8, 0, 1}}}), "motion");
  EXPECT_EQ(moved["gesture"], 4);
  const Json state = stateAfter({{"type", "release"}, {"gesture", 4}, {"seq", 1}});
  ASSERT_EQ(state["nails"].size(), 1u);
  EXPECT_EQ(state["nails"][0]["id"], nail);
  EXPECT_TRUE(std::abs(state["nails"][0]["constraint"]["position"][0].get<double>() - 0.8) <= 1e-6) << state["nails"];
  EXPECT_TRUE(state["nails"][0]["constraint"]["position"][1].is_null()) << "what was free stays free";
  ask(1, grab);
  EXPECT_EQ(stateAfter({{"type", "cancel"}, {"gesture", 4}})["nails"], state["nails"]);
  EXPECT_EQ(codeOf({{"type", "grab_nail"}, {"gesture", 5}, {"nail", 99}}), "input");
}

TEST_F(Messages, AGestureThatThePageForgotIsCancelledAndSaid) {
  ask(1, kGrab);
  ask(1, {{"type", "drag"}, {"gesture", 1}, {"seq", 1}, {"place", {0.9, 0, 1.1}}});
  Json next = kGrab;
  next["gesture"] = 2, next["body"] = "nobody";
  const std::vector<Json> got = ask(1, next);
  EXPECT_EQ(lastOf(got, "error")["code"], "input");
  const Json state = lastOf(got, "state");
  ASSERT_FALSE(state.is_null());
  EXPECT_TRUE(state["held_by"].is_null());
  EXPECT_EQ(state["numbers"][0]["now"], 1.5);
  EXPECT_FALSE(lastOf(got, "motion").is_null());
}

TEST_F(Messages, WhoHoldsABodyLetsGoFirst) {
  ask(1, kGrab);
  const Json rev = stateAfter({{"type", "stop"}})["rev"];
  for (const Json& message :
       {Json{{"type", "redo"}}, Json{{"type", "meet_nails"}}, Json{{"type", "nail"}, {"body", "ball"}, {"at", 0.3}},
        Json{{"type", "set_nail"}, {"nail", 0}, {"constraint", kConstraint}},
        Json{{"type", "nail_on"}, {"nail", 0}, {"on", true}}, Json{{"type", "unnail"}, {"nail", 0}},
        Json{{"type", "controls"}, {"rev", rev}, {"controls", Json::array()}},
        Json{{"type", "set"}, {"rev", rev}, {"edits", {{{"pointer", "/duration"}, {"value", 2}}}}},
        Json{{"type", "open"}, {"path", "bounce.json"}}})
    EXPECT_EQ(codeOf(message), "busy") << message;
  EXPECT_EQ(stateAfter({{"type", "undo"}})["held_by"], nullptr) << "undo lets go";
}

TEST_F(Messages, TheDurationIsTyped) {
  const Json rev = stateAfter({{"type", "stop"}})["rev"];
  const std::vector<Json> got =
      ask(1, {{"type", "set"}, {"rev", rev}, {"edits", {{{"pointer", "/duration"}, {"value", 0.5}}}}});
  EXPECT_EQ(lastOf(got, "state")["duration"], 0.5);
  EXPECT_EQ(lastOf(got, "motion")["end"], 0.5);
  EXPECT_EQ(stateAfter({{"type", "undo"}})["duration"], 1.2);
}

TEST_F(Messages, SavesUnderAnotherNameAndAsksBeforeItReplaces) {
  folder.write("taken.json", "theirs");
  EXPECT_EQ(codeOf({{"type", "save"}, {"path", "taken.json"}}), "conflict");
  EXPECT_EQ(folder.read("taken.json"), "theirs");
  const std::vector<Json> got = ask(1, {{"type", "save"}, {"path", "taken.json"}, {"replace", true}});
  EXPECT_EQ(lastOf(got, "saved")["path"], "taken.json");
  EXPECT_EQ(lastOf(got, "state")["path"], "taken.json");
  EXPECT_EQ(folder.read("taken.json"), kTestScene);
  EXPECT_EQ(codeOf({{"type", "save"}, {"path", "taken.txt"}}), "input");
  EXPECT_EQ(codeOf({{"type", "save"}, {"path", "../taken.json"}}), "input");
}

TEST_F(Messages, FilesThatAreTooLargeAndDisksThatFail) {
  folder.write("large.json", "{");
  std::filesystem::resize_file(folder / "large.json", kLargestDocument + 1);
  EXPECT_EQ(codeOf({{"type", "open"}, {"path", "large.json"}}), "too_large");
  const FileFailure failure("io", "'a.json': no space left on device");
  const Problem problem = problemOf(failure);
  EXPECT_EQ(problem.code, "io");
  EXPECT_EQ(problem.message, "'a.json': no space left on device");
}

TEST(Gallery, ItsScenesAreShownAndOpenWithoutAName) {
  TestFolder gallery;
  gallery.write("first.json", kTestScene);
  gallery.write("second.json", R"({"carom": 1, "bodies": []})");
  gallery.write("notes.txt", "no scene");
  WorkerTest test("", solvingWithoutClock(), gallery.path());
  test.hello(1);
  test.worker->step({});
  EXPECT_EQ(lastOf(test.received.take(1), "state")["open"], false);
  const Json scenes = lastOf(test.ask(1, {{"type", "gallery"}}), "gallery")["scenes"];
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[0]["name"], "A bounce");
  EXPECT_EQ(scenes[0]["picture"], "/gallery/first.png");
  EXPECT_EQ(scenes[1]["name"], "second");
  EXPECT_TRUE(scenes[1]["picture"].is_null());
  const std::vector<Json> opened = test.ask(1, {{"type", "open"}, {"path", "first.json"}, {"gallery", true}});
  EXPECT_FALSE(lastOf(opened, "progress").is_null());
  EXPECT_TRUE(lastOf(opened, "state")["path"].is_null());
  EXPECT_FALSE(lastOf(opened, "state")["saved"]);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "save"}}), "error")["code"], "input") << "it has no name yet";
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "save"}, {"path", "mine.json"}}), "saved")["path"], "mine.json");
  EXPECT_EQ(readDocument((test.folder / "mine.json").string()).name, "A bounce");
  EXPECT_EQ(gallery.read("first.json"), kTestScene);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "open"}, {"path", "../x.json"}, {"gallery", true}}), "error")["code"],
            "input");
}

TEST(NothingOpen, EverythingThatNeedsASceneSaysSo) {
  WorkerTest test("");
  test.hello(1);
  test.worker->step({});
  for (const Json& message :
       {kGrab, Json{{"type", "grab_nail"}, {"gesture", 1}, {"nail", 0}}, Json{{"type", "undo"}}, Json{{"type", "redo"}},
        Json{{"type", "meet_nails"}}, Json{{"type", "nail"}, {"constraint", kConstraint}},
        Json{{"type", "set_nail"}, {"nail", 0}, {"constraint", kConstraint}},
        Json{{"type", "nail_on"}, {"nail", 0}, {"on", true}}, Json{{"type", "unnail"}, {"nail", 0}},
        Json{{"type", "controls"}, {"rev", 0}, {"controls", Json::array()}},
        Json{{"type", "set"}, {"rev", 0}, {"edits", {{{"pointer", "/duration"}, {"value", 2}}}}},
        Json{{"type", "save"}, {"path", "a.json"}}}) {
    const Json error = lastOf(test.ask(1, message), "error");
    ASSERT_FALSE(error.is_null()) << message;
    EXPECT_EQ(error["code"], "input") << message;
    EXPECT_EQ(error["re"], test.id);
    EXPECT_NE(error["message"].get<std::string>().find("no open scene"), std::string::npos) << error;
  }
  for (const Json& message : {Json{{"type", "drag"}, {"gesture", 1}, {"seq", 1}, {"place", {0, 0, 1}}}, kRelease,
                              Json{{"type", "cancel"}, {"gesture", 1}}})
    EXPECT_EQ(lastOf(test.ask(1, message), "error")["code"], "not_held") << message;
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "stop"}}), "state")["open"], false);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "gallery"}}), "gallery")["scenes"].size(), 0u);
  EXPECT_EQ(lastOf(test.ask(1, {{"type", "open"}, {"path", "a.json"}, {"gallery", true}}), "error")["code"], "input");
}

}  // namespace
}  // namespace carom::studio
