// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>

namespace carom::studio {

/// Limits of clients. Tests make the times small.
struct Limits {
  std::size_t header = 8 * 1024;               ///< bytes of a request
  std::size_t connections = 64;                ///< open at a time
  std::size_t strangers = 8;                   ///< sockets that have not said hello
  std::size_t first_message = 4 * 1024;        ///< bytes of the first message of a socket
  std::size_t message = 1024 * 1024;           ///< bytes of every other
  std::size_t commands = 64;                   ///< of one socket that wait; then it is not read
  std::size_t outbox_messages = 256;           ///< that wait for a socket; then it is closed
  std::size_t outbox_bytes = 64u << 20;        ///< likewise
  std::chrono::milliseconds handshake{5000};   ///< for a request, for the hello of a socket, and for closing one
  std::chrono::milliseconds idle{30000};       ///< without a sign of life a socket is dead; half of it: a ping is sent
  /// A server at the port of one before gives no proof for so long (messages `prove`): a page takes none that is older
  /// than a second, so that whoever had the port meanwhile cannot pass on a question to this server.
  std::chrono::milliseconds no_proof{1500};
  std::chrono::milliseconds wrong_token{200};  ///< before a socket with a wrong token is closed
};

}  // namespace carom::studio
