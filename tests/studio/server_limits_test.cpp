// SPDX-License-Identifier: MIT
// What clients may take of a server that runs, and whom it lets in.
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

#include "tests/studio/test_server.h"

namespace carom::studio {
namespace {

constexpr std::array kFields = {"Content-Security-Policy: default-src 'none'; script-src 'self'",
                                "X-Content-Type-Options: nosniff",
                                "Referrer-Policy: no-referrer",
                                "Cross-Origin-Opener-Policy: same-origin",
                                "Cross-Origin-Resource-Policy: same-origin",
                                "Cache-Control: no-store"};

std::string upgradeOf(const Server& server, const std::string& more) {
  return getOf("/socket", server.host,
               server.origin() +
                   "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                   "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                   more);
}

TEST(ServerLimits, AreThoseOfTheDesign) {
  const Limits limits;
  EXPECT_EQ(limits.header, 8u << 10);
  EXPECT_EQ(limits.first_message, 4u << 10);
  EXPECT_EQ(limits.message, 1u << 20);
  EXPECT_EQ(limits.connections, 64u);
  EXPECT_EQ(limits.strangers, 8u);
  EXPECT_EQ(limits.commands, 64u);
  EXPECT_EQ(limits.outbox_messages, 256u);
  EXPECT_EQ(limits.outbox_bytes, 64u << 20);
  EXPECT_EQ(limits.handshake, std::chrono::seconds(5));
  EXPECT_EQ(limits.idle, std::chrono::seconds(30)) << "a ping after half of it";
  EXPECT_EQ(limits.wrong_token, std::chrono::milliseconds(200));
}

TEST(ServerLimits, ListensOnOneAddressOfThisMachine) {
  const Server server;
  EXPECT_NO_THROW(RawClient(server.port, 1));
  EXPECT_THROW(RawClient(server.port, 2), std::runtime_error) << "127.0.0.2 is loopback, too, but not where it is";
}

TEST(ServerLimits, LocalhostIsTheOtherName) {
  const Server server;
  const std::string local = "localhost:" + std::to_string(server.port);
  RawClient one = server.client();
  one.send(getOf("/main.js", local));
  EXPECT_EQ(statusOf(one.readAnswer()), 200);
  EXPECT_EQ(statusOf(server.client().upgrade(local, "Origin: http://" + local + "\r\n")), 101);
  EXPECT_EQ(statusOf(server.client().upgrade(local, server.origin())), 403) << "another Origin than its Host";
  EXPECT_EQ(statusOf(server.client().upgrade(server.host, "Origin: http://" + local + "\r\n")), 403);
}

TEST(ServerLimits, EveryAnswerHasTheFields) {
  const Server server;
  const auto answerTo = [&](const std::string& request, bool head = false) {
    RawClient client = server.client();
    client.send(request);
    return client.readAnswer(head);
  };
  const std::map<int, std::string> answers = {
      {200, answerTo("HEAD /main.js HTTP/1.1\r\nHost: " + server.host + "\r\n\r\n", true)},
      {404, answerTo(getOf("/none", server.host))},
      {403, answerTo(getOf("/", "evil.example"))},
      {405, answerTo("POST / HTTP/1.1\r\nHost: " + server.host + "\r\n\r\n")},
      {400, answerTo(getOf("/", server.host, "Transfer-Encoding: chunked\r\n"))},
      {431, answerTo(getOf("/", server.host, "X: " + std::string(9000, 'x') + "\r\n"))},
      {101, answerTo(upgradeOf(server, ""))}};
  for (const auto& [status, answer] : answers) {
    EXPECT_EQ(statusOf(answer), status) << answer;
    for (const char* field : kFields) EXPECT_NE(answer.find(field), std::string::npos) << status << ": " << field;
    EXPECT_EQ(answer.find("Beast"), std::string::npos) << status;
  }
}

TEST(ServerLimits, AHeaderUpToItsLimitIsRead) {
  const Server server;
  EXPECT_EQ(statusOf(server.get("/", "X: " + std::string(7900, 'x') + "\r\n")), 200);
}

TEST(ServerLimits, NothingIsCompressed) {
  const Server server;
  RawClient client = server.client();
  client.send(upgradeOf(server, "Sec-WebSocket-Extensions: permessage-deflate\r\n"));
  const std::string answer = client.readAnswer();
  EXPECT_EQ(statusOf(answer), 101);
  EXPECT_EQ(answer.find("permessage-deflate"), std::string::npos);
}

TEST(ServerLimits, AWrongTokenIsAnsweredLate) {
  Limits limits = patient();
  limits.wrong_token = Limits().wrong_token;
  const Server server(limits);
  RawClient page = server.client();
  page.upgrade(server.host, server.origin());
  const auto began = std::chrono::steady_clock::now();
  page.sendFrame(server.helloText(std::string(64, 'a')));
  page.sendFrame(server.helloText(server.token));  // no second try
  EXPECT_EQ(page.readToClose(), 4401);
  EXPECT_GE(std::chrono::steady_clock::now() - began, limits.wrong_token);
}

// What the page leaves unread fills the buffers of the system, then those of the server.
TEST(ServerLimits, APageThatDoesNotReadIsToldWhy) {
  Limits limits = patient();
  limits.outbox_messages = 20;
  const Server server(limits);
  RawClient page = server.page();
  waitFor(page, "state");
  bool open = true;
  for (int id = 2; open && id < 12'000; ++id)
    open = page.sendFrame("{\"type\": \"stop\", \"id\": " + std::to_string(id) + "}");
  EXPECT_TRUE(open);
  EXPECT_EQ(page.readToClose(), 1013);
}

TEST(ServerLimits, CommandsThatWaitAreReadLaterAndAllAnswered) {
  Limits limits = patient();
  limits.commands = 2;
  const Server server(limits);
  RawClient page = server.page();
  waitFor(page, "state");
  for (int id = 2; id < 200; ++id) page.sendFrame("{\"type\": \"list\", \"id\": " + std::to_string(id) + "}");
  for (int id = 2; id < 200; ++id) ASSERT_EQ(waitFor(page, "files")["re"], id);
}

TEST(ServerLimits, NumbersOfMessagesIncrease) {
  const Server server;
  RawClient page = server.page();
  waitFor(page, "state");
  for (const int id : {7, 7, 3}) page.sendFrame("{\"type\": \"list\", \"id\": " + std::to_string(id) + "}");
  for (const int id : {7, 3}) {
    const Json error = waitFor(page, "error");
    EXPECT_EQ(error["code"], "bad_message");
    EXPECT_EQ(error["pointer"], "/id");
    EXPECT_EQ(error["re"], id);
  }
}

TEST(ServerLimits, FiftyClientsAreServed) {
  const Server server;
  std::vector<RawClient> clients;
  for (int i = 0; i < 50; ++i) {
    clients.push_back(server.page());
    ASSERT_EQ(waitFor(clients.back(), "state")["path"], "bounce.json") << i;
  }
  for (RawClient& client : clients) client.sendFrame(R"({"type": "list", "id": 2})");
  for (RawClient& client : clients) EXPECT_EQ(waitFor(client, "files")["re"], 2);
  EXPECT_EQ(statusOf(server.get("/")), 200);
}

// All of them are pages; none of them is dropped for another.
TEST(ServerLimits, WhereAllAreKnownThereIsNoRoom) {
  Limits limits = patient();
  limits.connections = 3;
  const Server server(limits);
  std::vector<RawClient> pages;
  for (int i = 0; i < 3; ++i) {
    pages.push_back(server.page());
    waitFor(pages.back(), "state");
  }
  RawClient late = server.client();
  late.send(getOf("/", server.host));
  EXPECT_EQ(late.readToEnd(), "");
  for (RawClient& page : pages) {
    page.sendFrame(R"({"type": "list", "id": 2})");
    EXPECT_EQ(waitFor(page, "files")["re"], 2);
  }
}

}  // namespace
}  // namespace carom::studio
