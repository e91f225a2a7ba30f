// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom::studio {

/// What a request says, as far as it matters to whom it is answered.
struct Request {
  std::string method;                ///< "GET", ...
  std::string target;                ///< "/main.js?quality=low"
  std::vector<std::string> hosts;    ///< values of all fields Host
  std::vector<std::string> origins;  ///< values of all fields Origin
  bool upgrade = false;              ///< to a WebSocket
  bool body = false;                 ///< has one
  std::vector<std::string> encodings = {};  ///< values of all fields Accept-Encoding
};

/// Whether a request is answered.
struct Verdict {
  int status = 200;      ///< of HTTP; 200: go on
  std::string sentence;  ///< why not
};

/// Lets in what comes from pages of this server alone: the Host is exactly 127.0.0.1 or localhost with the port, so
/// that a foreign name that resolves to this machine gets nothing; the Origin of a socket is exactly that Host. Only
/// GET and HEAD, and no body.
Verdict judge(const Request& request, unsigned short port);

/// The path of a target, without its query.
std::string_view pathOf(std::string_view target);

/// 32 bytes from the kernel, in hex. Throws std::system_error.
std::string newToken();
/// Bytes in hex.
std::string hexOf(std::string_view bytes);
/// So many bytes from the kernel, in hex.
std::string randomHex(std::size_t bytes);
/// Takes as long for every text of the same length.
bool sameToken(std::string_view given, std::string_view token);

/// Fields of every answer: what the page may load and do, and that nothing is kept or shown elsewhere. The nonce lets
/// one inline script run; empty: none.
std::vector<std::pair<std::string, std::string>> securityHeaders(const std::string& nonce);

}  // namespace carom::studio
