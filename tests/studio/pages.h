// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "studio/mailbox.h"
#include "studio/protocol.h"
#include "studio/worker.h"
#include "tests/studio/share_folder.h"
#include "tests/studio/test_scene.h"

/// A worker with pages that are not there: what it sends is kept.
namespace carom::studio {

using Json = nlohmann::json;

/// A message as a page sees it: of a frame its header.
inline Json readMessage(const std::string& bytes) {
  if (!bytes.starts_with("CRM1")) return Json::parse(bytes);
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 4, sizeof length);
  return Json::parse(bytes.substr(8, length));
}

/// All that was sent. Messages that give way are kept, too. For use from two threads.
class Received {
 public:
  void add(SocketId to, const Outgoing& message) {
    const std::lock_guard lock(mutex_);
    messages_.emplace_back(to, readMessage(message.encode()));
    came_.notify_all();
  }
  /// Those of a socket since the last call that took them.
  std::vector<Json> take(SocketId socket) {
    const std::lock_guard lock(mutex_);
    std::vector<Json> found;
    std::erase_if(messages_, [&](const auto& message) {
      if (message.first == socket) found.push_back(message.second);
      return message.first == socket;
    });
    return found;
  }
  /// Waits for a message to a socket that is as asked, and forgets those to it that came before.
  template <class Wanted>
  Json wait(SocketId socket, const Wanted& wanted) {
    std::unique_lock lock(mutex_);
    for (;;) {
      for (auto it = messages_.begin(); it != messages_.end(); ++it) {
        if (it->first != socket || !wanted(it->second)) continue;
        Json found = it->second;
        const auto later = messages_.erase(it);
        messages_.erase(std::remove_if(messages_.begin(), later, [&](const auto& m) { return m.first == socket; }), later);
        return found;
      }
      came_.wait(lock);
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<std::pair<SocketId, Json>> messages_;
};

/// Of a type; with the number of a command that it answers.
inline auto isType(const std::string& type, std::int64_t re = 0) {
  return [type, re](const Json& message) {
    return message["type"] == type && (re == 0 || message.value("re", std::int64_t{0}) == re);
  };
}

/// Sessions without a clock: the same on every machine.
inline SessionOptions solvingWithoutClock() {
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  options.release_iterations = 40;
  return options;
}

/// A worker on a folder with the scene "bounce.json"; with an empty scene nothing is there and nothing open.
struct WorkerTest {
  TestFolder folder;
  Mailbox mailbox;
  Received received;
  std::unique_ptr<Workspace> workspace;
  std::unique_ptr<Worker> worker;
  std::int64_t id = 0;

  explicit WorkerTest(const std::string& scene = kTestScene, const SessionOptions& solving = solvingWithoutClock(),
                      const std::string& gallery = "") {
    if (!scene.empty()) folder.write("bounce.json", scene);
    workspace = std::make_unique<Workspace>(folder.path());
    WorkerOptions options;
    options.session = "s1";
    options.solving = solving;
    options.gallery = gallery;
    options.pictures = {"first"};
    worker = std::make_unique<Worker>(mailbox, *workspace,
                                      Post{[this](SocketId to, const Outgoing& message) { received.add(to, message); }},
                                      options);
    if (!scene.empty()) worker->openFirst("bounce.json");
  }
  /// Sends a message, which gets a number.
  std::int64_t send(SocketId from, Json message) {
    message["id"] = ++id;
    mailbox.put({from, readCommand(message.dump())});
    return id;
  }
  void hello(SocketId from) {
    send(from, {{"type", "hello"}, {"protocol", 1}, {"token", ""}, {"tab", "tab" + std::to_string(from)}});
  }
  /// Sends it, lets the worker do it, and gives what that socket got.
  std::vector<Json> ask(SocketId from, const Json& message) {
    received.take(from);
    send(from, message);
    worker->step({});
    return received.take(from);
  }
};

/// Takes hold of the ball of the test scene on its way up; drags it.
inline const Json kGrab = {{"type", "grab"}, {"gesture", 1}, {"body", "ball"}, {"at", 0.3}};
inline Json dragTo(std::int64_t seq, double x, double z) {
  return {{"type", "drag"}, {"gesture", 1}, {"seq", seq}, {"place", {x, 0, z}}};
}

/// The last message of a type; null where there is none.
inline Json lastOf(const std::vector<Json>& messages, const std::string& type) {
  for (auto it = messages.rbegin(); it != messages.rend(); ++it)
    if ((*it)["type"] == type) return *it;
  return nullptr;
}

}  // namespace carom::studio
