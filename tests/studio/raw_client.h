// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace carom::studio {

/// A connection to a server on this machine that says exactly what it is told to. What waits, waits for the server; it
/// gives up, and the test fails, after half a minute.
class RawClient {
 public:
  /// The last byte of the address is 1 for where the server is: 127.0.0.1. Throws where nobody listens.
  explicit RawClient(unsigned short port, unsigned char last_byte = 1);
  ~RawClient();
  RawClient(RawClient&& other) noexcept;
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  /// Sends bytes. False: the server has closed the connection.
  bool send(std::string_view bytes);
  /// All that comes until the server closes the connection.
  std::string readToEnd();
  /// An answer of HTTP, with its body.
  std::string readAnswer(bool head = false);

  /// Becomes a WebSocket; gives the first line of the answer.
  std::string upgrade(const std::string& host, const std::string& origin_line, const std::string& path = "/socket");
  /// Sends a frame of a WebSocket: 1 text, 2 binary, 8 close.
  bool sendFrame(std::string_view payload, int opcode = 1);
  /// A frame that came.
  struct Frame {
    int opcode = 0;
    std::string payload;
    /// The code of a close; 0: it is none.
    int closeCode() const;
  };
  /// The next frame; none: the connection is closed.
  std::optional<Frame> readFrame();
  /// Reads frames until the connection is closed or a close came; gives its code, 0: there was none.
  int readToClose();

 private:
  bool fill();  // reads more; false: closed
  int socket_ = -1;
  std::string got_;
};

/// A GET of a path.
std::string getOf(const std::string& path, const std::string& host, const std::string& more = "");
/// "HTTP/1.1 403 Forbidden" -> 403.
int statusOf(const std::string& answer);

}  // namespace carom::studio
