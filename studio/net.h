// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "studio/gate.h"
#include "studio/limits.h"
#include "studio/outbox.h"
#include "studio/socket_id.h"

namespace carom::studio {

/// An answer to a GET.
struct HttpAnswer {
  int status = 200;                                         ///< of HTTP
  std::string type = "text/plain; charset=utf-8";           ///< of the media
  std::string body;                                         ///< all of it
  std::vector<std::pair<std::string, std::string>> fields;  ///< besides
};

/// Why a socket is closed.
struct CloseReason {
  std::uint16_t code = 1000;  ///< of RFC 6455, or from 4000 on
  std::string text;           ///< at most 120 bytes
};

/// What the network asks of the program, all in the thread of Net::run.
struct NetHandlers {
  std::function<HttpAnswer(const Request&)> answer;    ///< to a request that the gate lets in
  std::function<bool(SocketId, std::string)> message;  ///< false: not to be read on until Net::resume
  std::function<void(SocketId)> gone;                  ///< a socket that was open is no more
};

/// The HTTP and WebSocket server, on 127.0.0.1 alone. Sockets are those of the address /socket. Every function but
/// `run` may be called from any thread.
class Net {
 public:
  /// Listens; port 0: any that is free. Throws InputError where the port cannot be had.
  Net(unsigned short port, const Limits& limits, NetHandlers handlers);
  ~Net();
  Net(const Net&) = delete;
  Net& operator=(const Net&) = delete;

  unsigned short port() const;  ///< that it listens on
  void run();                   ///< serves until `stop`
  void stop();                  ///< closes all sockets with 1001 and ends `run`

  void send(SocketId socket, Outgoing message);  ///< a socket that is gone: nothing happens, as below
  void welcome(SocketId socket);                 ///< it has said hello
  void close(SocketId socket, CloseReason reason, std::chrono::milliseconds after = {});
  void resume(SocketId socket);  ///< may be read again

  struct State;  // of net.cpp

 private:
  std::unique_ptr<State> state_;
};

}  // namespace carom::studio
