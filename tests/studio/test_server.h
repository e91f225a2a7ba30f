// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "studio/studio.h"
#include "tests/studio/pages.h"
#include "tests/studio/raw_client.h"

namespace carom::studio {

inline constexpr std::chrono::milliseconds kNever{60'000};

/// Limits of time that no test comes to.
inline Limits patient() {
  Limits limits;
  limits.handshake = limits.idle = kNever;
  limits.wrong_token = std::chrono::milliseconds{1};
  return limits;
}

/// Serves until it is destroyed.
class Server {
 public:
  explicit Server(const Limits& limits = patient()) {
    folder.write("bounce.json", kTestScene);
    folder.write("sub/inside.json", kTestScene);
    folder.write("../outside-" + name() + ".json", kTestScene);
    std::filesystem::create_symlink("../outside-" + name() + ".json", folder / "link.json");
    std::filesystem::create_directory_symlink("..", folder / "up");
    options_.scene = (folder / "bounce.json").string();
    options_.share = share.path();
    options_.limits = limits;
    options_.solving = solvingWithoutClock();
    options_.stop = stop_.get_token();
    std::promise<std::string> ready;
    options_.ready = [&](const std::string& address) { ready.set_value(address); };
    thread_ = std::thread([this] { code = studio(options_); });
    const std::string address = ready.get_future().get();
    const std::size_t hash = address.find("/#");
    host = address.substr(7, hash - 7);
    token = address.substr(hash + 2);
    port = static_cast<unsigned short>(std::stoi(host.substr(host.find(':') + 1)));
  }
  ~Server() {
    stop();
    folder.remove("../outside-" + name() + ".json");
  }
  void stop() {
    stop_.request_stop();
    if (thread_.joinable()) thread_.join();
  }
  std::string name() const { return std::filesystem::path(folder.path()).filename().string(); }
  std::string origin() const { return "Origin: http://" + host + "\r\n"; }
  RawClient client() const { return RawClient(port); }
  std::string get(const std::string& path, const std::string& more = "") const {
    RawClient one(port);
    one.send(getOf(path, host, more));
    return one.readAnswer();
  }
  std::string helloText(const std::string& with, int protocol = 1) const {
    return Json{{"type", "hello"}, {"id", 1}, {"protocol", protocol}, {"token", with}, {"tab", "t"}}.dump();
  }
  /// A page that has been let in.
  RawClient page() const {
    RawClient page(port);
    EXPECT_EQ(statusOf(page.upgrade(host, origin())), 101);
    page.sendFrame(helloText(token));
    return page;
  }

  TestFolder folder;
  ShareFolder share;
  std::string host, token;
  unsigned short port = 0;
  int code = -1;

 private:
  StudioOptions options_;
  std::stop_source stop_;
  std::thread thread_;
};

/// The next message of a type; null where the socket ends before.
inline Json waitFor(RawClient& page, const std::string& type) {
  while (const auto frame = page.readFrame()) {
    if (frame->opcode != 1 && frame->opcode != 2) continue;
    const Json message = readMessage(frame->payload);
    if (message["type"] == type) return message;
  }
  return nullptr;
}

}  // namespace carom::studio
