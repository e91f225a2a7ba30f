// SPDX-License-Identifier: MIT
#include "tests/studio/raw_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace carom::studio {
namespace {

constexpr int kPatience = 30'000;  // ms

void waitFor(int socket, short events) {
  pollfd wait{socket, events, 0};
  if (::poll(&wait, 1, kPatience) <= 0) throw std::runtime_error("the server does nothing");
}

}  // namespace

RawClient::RawClient(unsigned short port, unsigned char last_byte)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl((127u << 24u) | last_byte);
  if (::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("no connection");
}

RawClient::~RawClient() {
  if (socket_ >= 0) ::close(socket_);
}

RawClient::RawClient(RawClient&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), got_(std::move(other.got_)) {}

bool RawClient::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EAGAIN || errno == EINTR)) {
      waitFor(socket_, POLLOUT);
      continue;
    }
    if (sent < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool RawClient::fill() {
  std::array<char, 65536> block;
  waitFor(socket_, POLLIN);
  const ssize_t got = ::recv(socket_, block.data(), block.size(), 0);
  if (got <= 0) return false;
  got_.append(block.data(), static_cast<std::size_t>(got));
  return true;
}

std::string RawClient::readToEnd() {
  while (fill()) {
  }
  return std::exchange(got_, "");
}

std::string RawClient::readAnswer(bool head) {
  const auto ends = [&] {
    const std::size_t end = got_.find("\r\n\r\n");
    if (end == std::string::npos) return std::string::npos;
    const std::size_t field = got_.find("Content-Length: ");
    const std::size_t body = head || field > end ? 0 : std::stoul(got_.substr(field + 16));
    return got_.size() >= end + 4 + body ? end + 4 + body : std::string::npos;
  };
  while (ends() == std::string::npos && fill()) {
  }
  const std::size_t end = std::min(ends(), got_.size());
  std::string answer = got_.substr(0, end);
  got_.erase(0, end);
  return answer;
}

std::string RawClient::upgrade(const std::string& host, const std::string& origin_line, const std::string& path) {
  send("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + origin_line +
       "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
       "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  const std::string answer = readAnswer(false);
  return answer.substr(0, answer.find('\r'));
}

bool RawClient::sendFrame(std::string_view payload, int opcode) {
  std::string frame(1, static_cast<char>(0x80 | opcode));
  const std::size_t size = payload.size();
  const int bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;
  frame += static_cast<char>(0x80 | (bytes == 0 ? size : bytes == 2 ? 126 : 127));
  for (int i = bytes - 1; i >= 0; --i) frame += static_cast<char>(size >> (8 * i));
  frame += std::string(4, '\0');  // a mask that changes nothing
  frame += payload;
  return send(frame);
}

std::optional<RawClient::Frame> RawClient::readFrame() {
  const auto need = [&](std::size_t count) {
    while (got_.size() < count)
      if (!fill()) return false;
    return true;
  };
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(got_[i]); };
  if (!need(2)) return std::nullopt;
  const std::size_t small = byte(1) & 0x7fu, bytes = small < 126 ? 0 : small == 126 ? 2 : 8;
  if (!need(2 + bytes)) return std::nullopt;
  std::size_t size = bytes == 0 ? small : 0;
  for (std::size_t i = 0; i < bytes; ++i) size = size << 8u | byte(2 + i);
  if (!need(2 + bytes + size)) return std::nullopt;
  Frame frame{byte(0) & 0x0f, got_.substr(2 + bytes, size)};
  got_.erase(0, 2 + bytes + size);
  return frame;
}

int RawClient::Frame::closeCode() const {
  if (opcode != 8 || payload.size() < 2) return 0;
  return static_cast<unsigned char>(payload[0]) << 8 | static_cast<unsigned char>(payload[1]);
}

int RawClient::readToClose() {
  while (const std::optional<Frame> frame = readFrame())
    if (frame->opcode == 8) return frame->closeCode();
  return 0;
}

std::string getOf(const std::string& path, const std::string& host, const std::string& more) {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n";
}

int statusOf(const std::string& answer) { return answer.size() < 12 ? 0 : std::atoi(answer.c_str() + 9); }

}  // namespace carom::studio
