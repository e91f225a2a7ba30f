// SPDX-License-Identifier: MIT
// The studio's server, whose sockets and session have a thread each, with pages that ask at once.
#include <gtest/gtest.h>

#include <thread>

#include "tests/studio/test_server.h"

namespace carom::studio {
namespace {

/// Sends a message, and reads until it is answered by a state or an error.
Json answerTo(RawClient& page, const Json& message) {
  page.sendFrame(message.dump());
  while (const auto frame = page.readFrame()) {
    if (frame->opcode != 1) continue;
    const Json answer = readMessage(frame->payload);
    const bool is_end = answer["type"] == "state" || answer["type"] == "error";
    if (is_end && answer.value("re", 0) == message["id"]) return answer;
  }
  return nullptr;
}

TEST(StudioServer, PagesDragInTurnAndOneGoesWhileItHolds) {
  Server server;
  const auto live = [&server](int tab) {
    RawClient page = server.page();
    int id = 1;
    for (int gesture = 1; gesture <= 4; ++gesture) {
      const Json held =
          answerTo(page, {{"type", "grab"}, {"id", ++id}, {"gesture", gesture}, {"body", "ball"}, {"at", 0.3}});
      ASSERT_FALSE(held.is_null());
      EXPECT_TRUE(held["type"] == "state" || held["code"] == "busy") << held;
      for (int seq = 1; seq <= 5; ++seq) {
        Json drag = {{"type", "drag"}, {"gesture", gesture}, {"seq", seq}, {"place", {0.5 + 0.02 * seq, 0, 1}}};
        drag["id"] = ++id;
        page.sendFrame(drag.dump());
      }
      if (gesture == 4 && tab == 1) return;  // and closes
      const Json end = answerTo(page, {{"type", "release"}, {"id", ++id}, {"gesture", gesture}, {"seq", 6}});
      ASSERT_FALSE(end.is_null());
      EXPECT_TRUE(end["type"] == "state" || end["code"] == "not_held") << end;
    }
  };
  std::vector<std::thread> tabs;
  for (int tab = 1; tab <= 3; ++tab) tabs.emplace_back(live, tab);
  for (std::thread& tab : tabs) tab.join();
  RawClient last = server.page();
  const Json undone = answerTo(last, {{"type", "stop"}, {"id", 2}});
  EXPECT_EQ(undone["type"], "state");
  server.stop();
  EXPECT_EQ(last.readToClose(), 1001);
  EXPECT_EQ(server.code, 0);
}

}  // namespace
}  // namespace carom::studio
