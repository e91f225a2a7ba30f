// SPDX-License-Identifier: MIT
#include "studio/gate.h"

#include <sys/random.h>

#include <cerrno>
#include <system_error>

namespace carom::studio {
namespace {

constexpr std::size_t kTokenBytes = 32;

}  // namespace

Verdict judge(const Request& request, unsigned short port) {
  const std::string number = std::to_string(port);
  const bool host_fits = request.hosts.size() == 1 &&
                         (request.hosts[0] == "127.0.0.1:" + number || request.hosts[0] == "localhost:" + number);
  if (!host_fits) return {403, "found another Host, expected 127.0.0.1:" + number + " or localhost:" + number};
  if (request.method != "GET" && (request.method != "HEAD" || request.upgrade))
    return {405, "found another method, expected GET or HEAD"};
  if (request.body) return {400, "found a request with a body, expected none"};
  if (request.upgrade && (request.origins.size() != 1 || request.origins[0] != "http://" + request.hosts[0]))
    return {403, "found another Origin, expected http://" + request.hosts[0]};
  return {};
}

std::string_view pathOf(std::string_view target) { return target.substr(0, target.find('?')); }

std::string hexOf(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char byte : bytes) {
    const auto value = static_cast<unsigned char>(byte);
    text += kDigits[value >> 4u];
    text += kDigits[value & 15u];
  }
  return text;
}

std::string randomHex(std::size_t bytes) {
  std::string random(bytes, '\0');
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t got = ::getrandom(random.data() + done, bytes - done, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::system_error(errno, std::generic_category(), "getrandom");
    done += static_cast<std::size_t>(got);
  }
  return hexOf(random);
}

std::string newToken() { return randomHex(kTokenBytes); }

bool sameToken(std::string_view given, std::string_view token) {
  if (given.size() != token.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i)
    difference |= static_cast<unsigned>(static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i]));
  return difference == 0;
}

std::vector<std::pair<std::string, std::string>> securityHeaders(const std::string& nonce) {
  const std::string inline_script = nonce.empty() ? "" : " 'nonce-" + nonce + "'";
  return {{"Content-Security-Policy",
           "default-src 'none'; script-src 'self'" + inline_script +
               "; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; base-uri 'none'; "
               "form-action 'none'; frame-ancestors 'none'"},
          {"X-Content-Type-Options", "nosniff"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Opener-Policy", "same-origin"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cache-Control", "no-store"}};
}

}  // namespace carom::studio
