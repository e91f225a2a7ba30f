// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "studio/limits.h"
#include "studio/mailbox.h"
#include "studio/net.h"

namespace carom::studio {

/// Where messages of sockets go: hello with the right token first, then commands to the mailbox. Who does otherwise is
/// told so. For the thread of the network.
class Dispatcher {
 public:
  /// How it answers.
  struct Line {
    std::function<void(SocketId, std::string)> tell;
    std::function<void(SocketId)> welcome;
    std::function<void(SocketId, CloseReason, std::chrono::milliseconds)> close;
  };

  Dispatcher(Mailbox& mailbox, std::string token, const Limits& limits, Line line)
      : mailbox_(mailbox), token_(std::move(token)), limits_(limits), line_(std::move(line)) {}

  /// No proof that the token is known here is given before that.
  void provesFrom(std::chrono::steady_clock::time_point time) { proves_from_ = time; }
  /// A message. False: the socket should not be read until there is room.
  bool message(SocketId socket, const std::string& text);
  /// A socket that is no more.
  void gone(SocketId socket);

 private:
  bool greet(SocketId socket, Command command);
  bool prove(SocketId socket, std::int64_t id, const std::string& nonce);

  Mailbox& mailbox_;
  const std::string token_;
  const Limits limits_;
  const Line line_;
  std::chrono::steady_clock::time_point proves_from_{};
  std::map<SocketId, std::int64_t> known_;  // and the number of its last message
  std::set<SocketId> refused_;
};

}  // namespace carom::studio
