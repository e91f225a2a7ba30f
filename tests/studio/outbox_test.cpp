// SPDX-License-Identifier: MIT
// What waits for a page, and how many connections there may be.
#include "studio/outbox.h"

#include <gtest/gtest.h>

#include "studio/limits.h"
#include "studio/peers.h"

namespace carom::studio {
namespace {

Outgoing text(const std::string& content, std::size_t bytes = 1) {
  return {[content] { return content; }, bytes};
}
Outgoing motion(const std::string& content, bool gives_way) {
  return {[content] { return content; }, 10, true, gives_way, true};
}
std::string contentOf(Outbox& outbox) {
  std::string all;
  while (const auto next = outbox.pop()) all += next->encode();
  return all;
}

TEST(Outbox, OneMotionWaitsAndTheNewestIsIt) {
  Outbox outbox(256, 1000);
  for (const char* content : {"a", "b", "c"}) EXPECT_TRUE(outbox.push(motion(content, true)));
  outbox.push(text("s"));
  EXPECT_TRUE(outbox.push(motion("d", true)));
  EXPECT_EQ(contentOf(outbox), "sd");
  EXPECT_TRUE(outbox.isEmpty());
}

TEST(Outbox, MotionsThatEndAGestureStay) {
  Outbox outbox(256, 1000);
  outbox.push(motion("a", true));
  outbox.push(motion("R", false));
  outbox.push(motion("b", true));
  outbox.push(motion("c", true));
  EXPECT_EQ(contentOf(outbox), "Rc");
}

TEST(Outbox, HasRoomForSoManyMessagesAndBytes) {
  Outbox few(3, 1000);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(few.push(text("x")));
  EXPECT_FALSE(few.push(text("x")));
  few.pop();
  EXPECT_TRUE(few.push(text("x")));
  Outbox small(100, 25);
  EXPECT_TRUE(small.push(motion("a", true)));
  EXPECT_TRUE(small.push(motion("b", true)));
  EXPECT_TRUE(small.push(text("x", 15))) << "those that gave way have left their room";
  EXPECT_FALSE(small.push(text("y")));
  const Limits limits;
  Outbox usual(limits.outbox_messages, limits.outbox_bytes);
  for (int i = 0; i < 256; ++i) EXPECT_TRUE(usual.push(text("x")));
  EXPECT_FALSE(usual.push(text("x")));
}

struct Client final : Peer {
  void drop() override { dropped = true; }
  bool dropped = false;
};

TEST(Peers, TheOldestThatIsNotKnownGivesWay) {
  Peers peers;
  std::vector<std::shared_ptr<Client>> clients;
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(peers.makeRoom(3));
    clients.push_back(std::make_shared<Client>());
    peers.add(clients.back());
  }
  clients[0]->is_socket = clients[0]->is_known = true;
  EXPECT_TRUE(peers.makeRoom(3));
  EXPECT_FALSE(clients[0]->dropped);
  EXPECT_TRUE(clients[1]->dropped);
  EXPECT_FALSE(clients[2]->dropped);
  clients[2]->is_known = true;
  EXPECT_FALSE(peers.makeRoom(2)) << "all are known";
  clients.clear();
  EXPECT_TRUE(peers.makeRoom(1)) << "those that are gone do not count";
}

TEST(Peers, StrangersAreSocketsThatHaveNotSaidHello) {
  Peers peers;
  std::vector<std::shared_ptr<Client>> clients;
  for (int i = 0; i < 4; ++i) {
    clients.push_back(std::make_shared<Client>());
    clients.back()->is_socket = i != 0;
    clients.back()->is_known = i == 1;
    peers.add(clients.back());
  }
  peers.makeRoomForStranger(3);
  for (const auto& client : clients) EXPECT_FALSE(client->dropped);
  peers.makeRoomForStranger(2);
  EXPECT_TRUE(clients[2]->dropped);
  EXPECT_FALSE(clients[0]->dropped || clients[1]->dropped || clients[3]->dropped);
}

}  // namespace
}  // namespace carom::studio
