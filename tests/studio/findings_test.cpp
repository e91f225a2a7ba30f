// SPDX-License-Identifier: MIT
// What is looked for in the background: what would help, other solutions, and that a hand ends it.
#include "studio/findings.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

TEST(BackgroundThread, ANewerJobEndsTheOneBefore) {
  Background background;
  std::atomic<int> begun = 0, ended = 0, last = 0;
  const auto job = [&](int number) {
    return [&, number](const std::stop_token& stop) {
      ++begun, last = number;
      while (!stop.stop_requested()) std::this_thread::yield();
      ++ended;
    };
  };
  background.start(job(1));
  while (begun < 1) std::this_thread::yield();
  background.start(job(2));
  while (begun < 2) std::this_thread::yield();
  EXPECT_EQ(last, 2);
  EXPECT_EQ(ended, 1);
  background.cancel();
  background.wait();
  EXPECT_EQ(ended, 2);
  background.wait();  // nothing is under way
}

TEST(BackgroundThread, EndsWithWhatIsUnderWay) {
  std::atomic<bool> begun = false, ended = false;
  {
    Background background;
    background.start([&](const std::stop_token& stop) {
      begun = true;
      while (!stop.stop_requested()) std::this_thread::yield();
      ended = true;
    });
    while (!begun) std::this_thread::yield();
  }
  EXPECT_TRUE(ended);
}

class ExampleSearches : public testing::TestWithParam<const char*> {};

TEST_P(ExampleSearches, EndSoonAfterTheyAreTo) {
  using Clock = std::chrono::steady_clock;
  const Document document = readDocument(projectFile("examples/scenes/") + GetParam() + ".json");
  OdeContacts contacts(document.scene);
  EditSession session(document.scene, contacts, document.duration, document.controls, document.constraints, solvingWithoutClock());
  session.meetNails();
  Mailbox mailbox;
  Background background;
  background.start([&](const std::stop_token& stop) { findAlternatives(mailbox, 1, session.snapshot(), 6, stop); });
  std::this_thread::sleep_for(std::chrono::milliseconds(80));  // in the middle of it, or done
  const bool done = !mailbox.isEmpty();
  const auto began = Clock::now();
  background.cancel();
  background.wait();
  std::printf("%s: %s ended %.0f ms after it was to\n", GetParam(), done ? "which was done," : "the search",
              std::chrono::duration<double, std::milli>(Clock::now() - began).count());
  EXPECT_EQ(mailbox.isEmpty(), !done) << "nothing comes any more";
}

INSTANTIATE_TEST_SUITE_P(Examples, ExampleSearches, testing::Values("book-on-shelf", "mug-on-mark", "hat", "dice"));

struct Asking : testing::Test, WorkerTest {
  Json state;

  void SetUp() override {
    hello(1);
    worker->step({});
    state = lastOf(received.take(1), "state");
  }
  std::vector<Json> say(Json message) {
    const std::vector<Json> got = ask(1, std::move(message));
    if (const Json next = lastOf(got, "state"); !next.is_null()) state = next;
    return got;
  }
  Json about(const std::string& type, Json more = Json::object()) const {
    more["type"] = type, more["rev"] = state["rev"];
    return more;
  }
  /// Steps until an answer of this type is there that is the last one.
  std::vector<Json> answers(const std::string& type) {
    std::vector<Json> all = received.take(1);
    while (lastOf(all, type).is_null() || lastOf(all, type).value("more", false)) {
      worker->step({});
      for (Json& message : received.take(1)) all.push_back(std::move(message));
    }
    return all;
  }
  /// The ball cannot be thrown aside: y is locked.
  void dragAside() {
    say(about("controls", {{"controls", {{{"vary", "velocity"}, {"body", "ball"}, {"components", {"x", "z"}}}}}}));
    say(kGrab);
    say({{"type", "drag"}, {"gesture", 1}, {"seq", 1}, {"place", {0.5, 0.2, 1}}});
    const std::vector<Json> end = say({{"type", "release"}, {"gesture", 1}, {"seq", 1}});
    EXPECT_FALSE(lastOf(end, "motion")["reached"]);
  }
};

TEST_F(Asking, WhatWouldHelpIsToldAndTakenInOneStep) {
  dragAside();
  const std::int64_t asked = id + 1;
  send(1, about("why"));
  worker->step({});
  const std::vector<Json> told = answers("why");
  const Json first = told.front(), last = lastOf(told, "why");
  EXPECT_EQ(first["re"], asked);
  EXPECT_TRUE(first["more"]);
  EXPECT_TRUE(first["remedies"][0]["solves"].is_null()) << "it is named before it is tried";
  EXPECT_FALSE(last["more"]);
  const Json remedy = last["remedies"][0];
  EXPECT_EQ(remedy["name"], "Let the velocity.y of 'ball' change");
  EXPECT_EQ(remedy["kind"], "vary");
  EXPECT_TRUE(remedy["solves"]);
  const Json before = state;
  EXPECT_EQ(lastOf(say(about("remedy", {{"name", "no such"}})), "error")["code"], "stale");
  say(about("remedy", {{"name", remedy["name"]}}));
  EXPECT_EQ(state["rev"], before["rev"].get<int>() + 1);
  EXPECT_EQ(state["undo"], remedy["name"]);
  EXPECT_EQ(state["controls"][0]["components"], Json({"x", "z", "y"}));
  EXPECT_GT(state["bodies"][1]["velocity"][1], 0.5);
  EXPECT_EQ(lastOf(say(about("remedy", {{"name", remedy["name"]}})), "error")["code"], "stale") << "of a scene that is no more";
  say({{"type", "undo"}});
  EXPECT_EQ(state["controls"], before["controls"]);
  EXPECT_EQ(state["bodies"], before["bodies"]);
}

TEST_F(Asking, NothingIsSaidWhereNothingIsWrong) {
  send(1, about("why"));
  worker->step({});
  const Json answer = lastOf(answers("why"), "why");
  EXPECT_EQ(answer["remedies"].size(), 0u);
  EXPECT_EQ(answer["sentence"], "");
}

TEST_F(Asking, OtherSolutionsComeWithTheirMotions) {
  say(kGrab);
  say({{"type", "drag"}, {"gesture", 1}, {"seq", 1}, {"place", {0.6, 0.1, 1.1}}});
  say({{"type", "release"}, {"gesture", 1}, {"seq", 1}, {"nail", true}});
  send(1, about("alternatives", {{"count", 3}}));
  worker->step({});
  const std::vector<Json> told = answers("alternatives");
  const Json last = lastOf(told, "alternatives");
  EXPECT_EQ(last["re"], id);
  const auto frames = std::count_if(told.begin(), told.end(), [](const Json& one) { return one["type"] == "alternative"; });
  EXPECT_EQ(last["count"], frames);
  EXPECT_LE(frames, 3);
  if (frames == 0) EXPECT_NE(last["message"], "");
  for (const Json& one : told) {
    if (one["type"] != "alternative") continue;
    EXPECT_EQ(one["tracks"].size(), 3u) << "all of them: there is no motion before it";
    EXPECT_EQ(one["rev"], state["rev"]);
  }
  EXPECT_EQ(lastOf(say(about("adopt", {{"index", 11}})), "error")["code"], "input");
  if (frames == 0) return;
  const Json before = state;
  for (int index = 0; index < frames; ++index) {
    say(about("adopt", {{"index", index}}));
    EXPECT_EQ(state["undo"], "another solution");
    EXPECT_TRUE(state["nails"][0]["met"]) << "it meets the same";
  }
  for (int index = 0; index < frames; ++index) say({{"type", "undo"}});
  EXPECT_EQ(state["bodies"], before["bodies"]);
}

TEST_F(Asking, AGrabEndsItAndThatIsSaid) {
  dragAside();
  const Json question = about("why");
  const std::int64_t asked = id + 1;
  send(1, question);
  worker->step({});
  received.take(1);
  Json grab = kGrab;
  grab["gesture"] = 2;
  send(1, grab);
  Json cancelled;
  while (cancelled.is_null()) {  // what was found meanwhile comes before it
    worker->step({});
    for (const Json& message : received.take(1))
      if (message["type"] == "why" && message.contains("cancelled")) cancelled = message;
  }
  EXPECT_EQ(cancelled["re"], asked);
  EXPECT_EQ(lastOf(ask(1, {{"type", "alternatives"}, {"rev", question["rev"]}}), "error")["code"], "busy");
}

TEST_F(Asking, OfAnOlderSceneIsRefused) {
  EXPECT_EQ(lastOf(say({{"type", "why"}, {"rev", 0}}), "error")["code"], "stale");
  EXPECT_EQ(lastOf(say({{"type", "alternatives"}, {"rev", 0}}), "error")["code"], "stale");
  EXPECT_EQ(lastOf(say(about("adopt", {{"index", 0}})), "error")["code"], "stale") << "nothing was asked for";
}

}  // namespace
}  // namespace carom::studio
