// SPDX-License-Identifier: MIT
// The thread of the studio's session with pages that ask from others; also for the thread sanitizer.
#include <gtest/gtest.h>

#include <thread>

#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

const Json kLateGrab = {{"type", "grab"}, {"gesture", 1}, {"body", "ball"}, {"at", 0.9}};

/// One that needs several updates for what it is dragged to.
struct RestingHand : testing::Test, WorkerTest {
  RestingHand()
      : WorkerTest(kTestScene, [] {
          SessionOptions options = solvingWithoutClock();
          options.drag_simulations = 1;
          return options;
        }()) {}
};

TEST_F(RestingHand, GoesOnTowardsItsTarget) {
  std::jthread thread([&](const std::stop_token& stop) { worker->run(stop); });
  hello(1);
  send(1, kLateGrab);
  send(1, dragTo(3, 2.2, 0.4));
  const auto isUpdate = [](const Json& message) { return message["type"] == "motion" && message.value("seq", 0) == 3; };
  const Json first = received.wait(1, isUpdate);
  ASSERT_FALSE(first["reached"]) << "the test needs a harder target";
  EXPECT_TRUE(first["more"]);
  double distance = first["distance"];
  Json next = first;
  while (next["more"]) {
    next = received.wait(1, isUpdate);
    EXPECT_LE(next["distance"].get<double>(), distance);
    distance = next["distance"];
  }
  EXPECT_TRUE(next["reached"]);
  EXPECT_LE(distance, 1e-6);
  thread.request_stop();
}

TEST_F(RestingHand, OutOfReachItComesToAnEndAndSaysWhy) {
  std::jthread thread([&](const std::stop_token& stop) { worker->run(stop); });
  hello(1);
  send(1, kLateGrab);
  send(1, dragTo(3, 500, 0.4));
  const Json last = received.wait(1, [](const Json& message) {
    return message["type"] == "motion" && message.value("seq", 0) == 3 && !message["more"];
  });
  EXPECT_FALSE(last["reached"]);
  EXPECT_GT(last["distance"].get<double>(), 100);
  send(1, {{"type", "release"}, {"gesture", 1}, {"seq", 4}});
  EXPECT_NE(received.wait(1, isType("motion", id))["obstacle"]["sentence"], "");
  thread.request_stop();
}

TEST_F(RestingHand, ANewDragTakesItsPlace) {
  std::jthread thread([&](const std::stop_token& stop) { worker->run(stop); });
  hello(1);
  send(1, kLateGrab);
  for (int seq = 1; seq <= 30; ++seq) send(1, dragTo(seq, 1.2 + 0.02 * seq, 0.4));
  const Json end = received.wait(1, [](const Json& message) {
    return message["type"] == "motion" && message.value("seq", 0) == 30 && !message["more"];
  });
  EXPECT_TRUE(end["reached"]);
  thread.request_stop();
}

/// One that is at its target after one update.
struct QuickHand : testing::Test, WorkerTest {};

// The next command waits already when the release begins, so it is stopped at once, on any machine.
TEST_F(QuickHand, AReleaseIsStoppedByTheNextCommand) {
  hello(1);
  worker->step({});
  ask(1, kLateGrab);
  received.take(1);
  const std::int64_t release = send(1, {{"type", "release"}, {"gesture", 1}, {"seq", 4}, {"place", {1.45, 0, 0.4}}});
  Json next = kLateGrab;
  next["gesture"] = 2;
  const std::int64_t grab = send(1, next);
  worker->step({});
  const std::vector<Json> first = received.take(1);
  EXPECT_EQ(lastOf(first, "motion")["re"], release);
  EXPECT_TRUE(lastOf(first, "motion")["stopped"]);
  EXPECT_FALSE(lastOf(first, "state")["undo"].is_null()) << "the best so far is a step";
  worker->step({});
  const Json held = lastOf(received.take(1), "state");
  EXPECT_EQ(held["re"], grab);
  EXPECT_EQ(held["held_by"], "tab1");
}

TEST_F(RestingHand, AStopEndsTheDragOfAReleaseToo) {
  hello(1);
  worker->step({});
  ask(1, kLateGrab);
  const std::int64_t release = send(1, {{"type", "release"}, {"gesture", 1}, {"seq", 4}, {"place", {2.2, 0, 0.4}}});
  const std::int64_t stop = send(1, {{"type", "stop"}});
  worker->step({});
  EXPECT_EQ(lastOf(received.take(1), "state")["re"], release);
  worker->step({});
  const Json state = lastOf(received.take(1), "state");
  EXPECT_EQ(state["re"], stop);
  EXPECT_TRUE(state["held_by"].is_null());
}

TEST(StudioWorker, ServesManyPagesAtOnce) {
  WorkerTest test;
  std::jthread thread([&](const std::stop_token& stop) { test.worker->run(stop); });
  std::mutex sending;  // numbers are given in one place
  const auto send = [&](SocketId from, const Json& message) {
    const std::lock_guard lock(sending);
    return test.send(from, message);
  };
  const auto answerTo = [](std::int64_t number) {
    return [number](const Json& message) {
      return message.value("re", std::int64_t{0}) == number &&
             (message["type"] == "state" || message["type"] == "error");
    };
  };
  std::vector<std::thread> pages;
  for (SocketId page = 1; page <= 3; ++page)
    pages.emplace_back([&, page] {
      const std::string tab = "tab" + std::to_string(page);
      test.received.wait(page, answerTo(send(page, {{"type", "hello"}, {"protocol", 1}, {"token", ""}, {"tab", tab}})));
      for (int gesture = 1; gesture <= 5; ++gesture) {
        const double x = 1 + 0.02 * gesture + 0.1 * static_cast<double>(page);
        send(page, {{"type", "grab"}, {"gesture", gesture}, {"body", "ball"}, {"at", 0.3}});
        for (int seq = 1; seq <= 5; ++seq)
          send(page, {{"type", "drag"}, {"gesture", gesture}, {"seq", seq}, {"place", {x, 0, 1 + 0.01 * seq}}});
        const Json end =
            test.received.wait(page, answerTo(send(page, {{"type", "release"}, {"gesture", gesture}, {"seq", 6}})));
        EXPECT_TRUE(end["type"] == "state" || end["code"] == "not_held") << end;
      }
    });
  for (std::thread& page : pages) page.join();
  Json state = test.received.wait(1, answerTo(send(1, {{"type", "stop"}})));
  EXPECT_TRUE(state["held_by"].is_null());
  for (int steps = 0; !state["undo"].is_null(); ++steps) {
    ASSERT_LE(steps, 15);
    state = test.received.wait(1, answerTo(send(1, {{"type", "undo"}})));
  }
  EXPECT_TRUE(state["saved"]);
  thread.request_stop();
}

}  // namespace
}  // namespace carom::studio
