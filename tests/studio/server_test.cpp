// SPDX-License-Identifier: MIT
// A server that runs, and clients that say what they should not.
#include <gtest/gtest.h>

#include <thread>

#include "adjoint/base/errors.h"
#include "tests/studio/test_server.h"

namespace carom::studio {
namespace {

constexpr std::chrono::milliseconds kSoon{150};  // for limits that a test waits for

TEST(Server, ServesThePageWithItsPolicy) {
  const Server server;
  const std::string page = server.get("/?quality=low");
  EXPECT_EQ(statusOf(page), 200);
  const std::size_t nonce = page.find("'nonce-");
  ASSERT_NE(nonce, std::string::npos);
  const std::string value = page.substr(nonce + 7, 32);
  EXPECT_NE(page.find("<script nonce=\"" + value + "\">"), std::string::npos);
  EXPECT_EQ(server.get("/").find(value), std::string::npos) << "a nonce is used once";
  for (const char* field :
       {"X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer", "Cache-Control: no-store",
        "Cross-Origin-Opener-Policy: same-origin", "Cross-Origin-Resource-Policy: same-origin"})
    EXPECT_NE(page.find(field), std::string::npos) << field;
  const std::string script = server.get("/main.js");
  EXPECT_NE(script.find("Content-Type: text/javascript; charset=utf-8"), std::string::npos);
  EXPECT_NE(script.find("script-src 'self';"), std::string::npos);
  EXPECT_EQ(page.find(server.token), std::string::npos);
}

TEST(Server, AnswersHeadAndSeveralRequestsOfAConnection) {
  const Server server;
  RawClient client = server.client();
  client.send("HEAD / HTTP/1.1\r\nHost: " + server.host + "\r\n\r\n");
  const std::string head = client.readAnswer(true);
  EXPECT_EQ(statusOf(head), 200);
  EXPECT_EQ(head.find("<!doctype"), std::string::npos);
  EXPECT_NE(head.find("Content-Length: "), std::string::npos);
  for (int i = 0; i < 3; ++i) {
    client.send(getOf("/main.js", server.host));
    EXPECT_EQ(statusOf(client.readAnswer()), 200);
  }
}

TEST(Server, RefusesOtherNamesMethodsAndHosts) {
  const Server server;
  for (const char* path : {"/../bounce.json", "/%2e%2e/bounce.json", "/page/index.html", "/bounce.json", "//index.html",
                           "/three/../main.js", "/main.js/", "/etc/passwd", "/socket", "*"})
    EXPECT_EQ(statusOf(server.get(path)), 404) << path;
  const auto answerTo = [&](const std::string& request) {
    RawClient client = server.client();
    client.send(request);
    return client.readToEnd();
  };
  const std::string port = server.host.substr(server.host.find(':'));
  for (const std::string& host :
       {std::string("evil.example") + port, std::string("127.0.0.1"), std::string("127.0.0.1:1")})
    EXPECT_EQ(statusOf(answerTo(getOf("/", host))), 403) << host;
  EXPECT_EQ(statusOf(answerTo("GET / HTTP/1.1\r\n\r\n")), 403);
  EXPECT_EQ(statusOf(answerTo(getOf("/", server.host, "Host: " + server.host + "\r\n"))), 403);
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS"}) {
    const std::string answer = answerTo(std::string(method) + " / HTTP/1.1\r\nHost: " + server.host + "\r\n\r\n");
    EXPECT_EQ(statusOf(answer), 405) << method;
    EXPECT_NE(answer.find("Allow: GET, HEAD"), std::string::npos);
  }
  EXPECT_EQ(statusOf(answerTo("POST / HTTP/1.1\r\nHost: " + server.host + "\r\nContent-Length: 9000000\r\n\r\nx")),
            405);
  EXPECT_EQ(statusOf(answerTo(getOf("/", server.host, "Content-Length: 5\r\n") + "hello")), 400);
  EXPECT_EQ(statusOf(answerTo("nonsense\r\n\r\n")), 400);
}

TEST(Server, RefusesAHeaderOfAMegabyte) {
  const Server server;
  RawClient client = server.client();
  client.send("GET / HTTP/1.1\r\nHost: " + server.host + "\r\nX: " + std::string(1u << 20, 'x') + "\r\n\r\n");
  EXPECT_EQ(statusOf(client.readToEnd()), 431);
  EXPECT_EQ(statusOf(server.get("/")), 200);
}

TEST(Server, SocketsComeFromItsOwnPagesAlone) {
  const Server server;
  for (const std::string& origin :
       {std::string(), std::string("Origin: null\r\n"), std::string("Origin: http://evil.example\r\n"),
        "Origin: https://" + server.host + "\r\n", server.origin() + server.origin()})
    EXPECT_EQ(statusOf(server.client().upgrade(server.host, origin)), 403) << origin;
  EXPECT_EQ(statusOf(server.client().upgrade("evil.example", "Origin: http://evil.example\r\n")), 403);
  EXPECT_EQ(statusOf(server.client().upgrade(server.host, server.origin(), "/other")), 404);
  EXPECT_EQ(statusOf(server.client().upgrade(server.host, server.origin())), 101);
}

TEST(Server, ATokenIsNeeded) {
  const Server server;
  const auto closedAfter = [&](const std::string& first) {
    RawClient page = server.client();
    page.upgrade(server.host, server.origin());
    page.sendFrame(first);
    EXPECT_EQ(waitFor(page, "error")["code"], "unauthorized") << first;
    return page.readToClose();
  };
  EXPECT_EQ(closedAfter(server.helloText("")), 4401);
  EXPECT_EQ(closedAfter(server.helloText(std::string(64, '0'))), 4401);
  EXPECT_EQ(closedAfter(server.helloText(server.token + "0")), 4401);
  EXPECT_EQ(closedAfter(R"({"type": "undo", "id": 1})"), 4401);
  EXPECT_EQ(closedAfter(server.helloText(server.token, 2)), 4400);
}

TEST(Server, APageGetsTheSceneAndDrags) {
  const Server server;
  RawClient page = server.page();
  EXPECT_EQ(waitFor(page, "welcome")["protocol"], 1);
  EXPECT_EQ(waitFor(page, "scene")["bodies"].size(), 3u);
  EXPECT_EQ(waitFor(page, "motion")["tracks"].size(), 3u);
  EXPECT_EQ(waitFor(page, "state")["path"], "bounce.json");
  page.sendFrame(R"({"type": "grab", "id": 2, "gesture": 1, "body": "ball", "at": 0.3})");
  EXPECT_EQ(waitFor(page, "state")["held_by"], "t");
  page.sendFrame(R"({"type": "drag", "id": 3, "gesture": 1, "seq": 1, "place": [0.6, 0, 1]})");
  EXPECT_EQ(waitFor(page, "motion")["seq"], 1);
  page.sendFrame(R"({"type": "cancel", "id": 4, "gesture": 1})");
  EXPECT_EQ(waitFor(page, "state")["re"], 4);
  int id = 4;
  for (const char* path : {"link.json", "up/a.json", "../outside.json", "sub/../../x.json", "/etc/passwd.json"}) {
    page.sendFrame(Json{{"type", "open"}, {"id", ++id}, {"path", path}}.dump());
    EXPECT_EQ(waitFor(page, "error")["code"], "input") << path;
    page.sendFrame(Json{{"type", "save"}, {"id", ++id}, {"path", path}, {"replace", true}}.dump());
    EXPECT_EQ(waitFor(page, "error")["code"], "input") << path;
  }
  EXPECT_EQ(server.folder.read("../outside-" + server.name() + ".json"), kTestScene);
  page.sendFrame(R"({"type": "undo", "id": 97, "more": 1})");
  const Json error = waitFor(page, "error");
  EXPECT_EQ(error["code"], "bad_message");
  EXPECT_EQ(error["re"], 97);
  page.sendFrame(server.helloText(server.token));
  EXPECT_EQ(waitFor(page, "error")["code"], "bad_message");
}

TEST(Server, LargeMessagesCloseTheSocket) {
  const Server server;
  RawClient stranger = server.client();
  stranger.upgrade(server.host, server.origin());
  stranger.sendFrame(std::string(5000, ' '));
  EXPECT_EQ(stranger.readToClose(), 1009);
  RawClient page = server.page();
  waitFor(page, "state");
  page.sendFrame(R"({"type": "list", "id": 2})" + std::string(900'000, ' '));
  EXPECT_EQ(waitFor(page, "files")["re"], 2);
  page.sendFrame(std::string(2u << 20, ' '));
  EXPECT_EQ(page.readToClose(), 1009);
  RawClient binary = server.page();
  waitFor(binary, "state");
  binary.sendFrame("123", 2);
  EXPECT_EQ(binary.readToClose(), 1003);
}

TEST(Server, ClientsThatDoNotSpeakAreClosed) {
  Limits limits = patient();
  limits.handshake = kSoon;
  const Server server(limits);
  EXPECT_EQ(server.client().readToEnd(), "");
  RawClient slow = server.client();
  slow.send("GET / HTTP/1.1\r\nHo");
  EXPECT_EQ(slow.readToEnd(), "");
  RawClient kept = server.client();
  kept.send(getOf("/main.js", server.host));
  EXPECT_EQ(statusOf(kept.readToEnd()), 200);
  RawClient silent = server.client();
  EXPECT_EQ(statusOf(silent.upgrade(server.host, server.origin())), 101);
  EXPECT_EQ(silent.readToClose(), 1008);
}

TEST(Server, APageThatDoesNotAnswerPingsIsDead) {
  Limits limits = patient();
  limits.idle = kSoon;
  const Server server(limits);
  RawClient page = server.page();
  waitFor(page, "state");
  bool pinged = false;
  while (const auto frame = page.readFrame()) pinged = pinged || frame->opcode == 9;
  EXPECT_TRUE(pinged);
}

TEST(Server, APageThatDoesNotReadIsClosed) {
  Limits limits = patient();
  limits.outbox_messages = 20;
  limits.handshake = kSoon;
  const Server server(limits);
  RawClient page = server.page();
  waitFor(page, "state");
  bool open = true;
  for (int id = 2; open && id < 2'000'000; ++id)
    open = page.sendFrame("{\"type\": \"stop\", \"id\": " + std::to_string(id) + "}");
  EXPECT_FALSE(open);
  EXPECT_EQ(statusOf(server.get("/")), 200);
}

TEST(Server, SilentClientsKeepNobodyOut) {
  Limits limits = patient();
  limits.connections = 12;
  limits.strangers = 3;
  const Server server(limits);
  RawClient page = server.page();
  waitFor(page, "state");
  std::vector<RawClient> silent;
  for (int i = 0; i < 30; ++i) silent.push_back(server.client());
  EXPECT_EQ(statusOf(server.get("/")), 200);
  std::vector<RawClient> strangers;
  for (int i = 0; i < 5; ++i) {
    strangers.push_back(server.client());
    EXPECT_EQ(statusOf(strangers.back().upgrade(server.host, server.origin())), 101);
  }
  EXPECT_EQ(strangers.front().readToClose(), 0) << "the oldest gave way";
  page.sendFrame(R"({"type": "list", "id": 2})");
  EXPECT_EQ(waitFor(page, "files")["re"], 2) << "those who said hello stay";
}

TEST(Server, EndsCleanly) {
  Server server;
  RawClient page = server.page();
  waitFor(page, "state");
  page.sendFrame(R"({"type": "grab", "id": 2, "gesture": 1, "body": "ball", "at": 0.3})");
  waitFor(page, "state");
  std::thread stopping([&] { server.stop(); });
  EXPECT_EQ(page.readToClose(), 1001);
  stopping.join();
  EXPECT_EQ(server.code, 0);
}

TEST(Server, RefusesToStartWithoutWhatItNeeds) {
  const TestFolder folder;
  const ShareFolder share;
  folder.write("a.json", kTestScene);
  folder.write("sub/b.json", kTestScene);
  folder.write("broken.json", "{");
  const auto start = [&](const std::string& scene, const std::string& below) {
    StudioOptions options;
    options.share = share.path();
    options.scene = scene.empty() ? "" : (folder / scene).string();
    options.folder = below.empty() ? "" : (folder / below).string();
    std::stop_source stop;
    stop.request_stop();
    options.stop = stop.get_token();
    return studio(options);
  };
  EXPECT_EQ(start("a.json", ""), 0);
  EXPECT_EQ(start("sub/b.json", "."), 0);
  EXPECT_THROW(start("a.json", "sub"), InputError);
  EXPECT_THROW(start("nowhere.json", ""), InputError);
  EXPECT_THROW(start("broken.json", ""), InputError);
  EXPECT_THROW(start("", "nowhere"), InputError);
  share.remove("three");
  EXPECT_THROW(start("a.json", ""), InputError);
}

}  // namespace
}  // namespace carom::studio
