// SPDX-License-Identifier: MIT
// The stream below the WebSockets of net.cpp, which alone includes it.
#pragma once

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <cstddef>
#include <memory>
#include <utility>

namespace carom::studio {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;
using Error = boost::system::error_code;
using Executor = asio::io_context::executor_type;  // the only one: Asio's default holds any, in more code
using TcpSocket = asio::basic_stream_socket<tcp, Executor>;

/// What is called when bytes have come or gone, of one type for all: Asio makes some twenty functions for every type of
/// handler and of buffers, and half the time that this file takes would be spent on them.
class Done {
 public:
  template <class Handler>
  explicit Done(Handler handler) : call_(std::make_unique<Holding<Handler>>(std::move(handler))) {}
  void operator()(Error error, std::size_t bytes) { std::exchange(call_, nullptr)->run(error, bytes); }

 private:
  struct Call {
    virtual ~Call() = default;
    virtual void run(Error error, std::size_t bytes) = 0;
  };
  template <class Handler>
  struct Holding final : Call {
    explicit Holding(Handler the_handler) : handler(std::move(the_handler)) {}
    void run(Error error, std::size_t bytes) override { handler(error, bytes); }
    Handler handler;
  };
  std::unique_ptr<Call> call_;
};

/// The first buffers of a sequence that are not empty: as many as Beast's messages have.
template <class Buffer>
class FirstBuffers {
 public:
  template <class Buffers>
  explicit FirstBuffers(const Buffers& buffers) {
    for (auto it = asio::buffer_sequence_begin(buffers); it != asio::buffer_sequence_end(buffers); ++it)
      if (const Buffer buffer(*it); buffer.size() > 0 && size_ < buffers_.size()) buffers_[size_++] = buffer;
  }
  const Buffer* begin() const { return buffers_.data(); }
  const Buffer* end() const { return buffers_.data() + size_; }

 private:
  std::array<Buffer, 8> buffers_;
  std::size_t size_ = 0;
};

/// Beast's TCP stream, with timeouts.
class Stream {
 public:
  using executor_type = Executor;
  using Tcp = beast::basic_stream<tcp, Executor>;
  explicit Stream(TcpSocket socket) : tcp_(std::move(socket)) {}
  Executor get_executor() { return tcp_.get_executor(); }
  Tcp& next_layer() { return tcp_; }

  template <class Buffers, class Handler>
  void async_read_some(const Buffers& buffers, Handler&& handler) {
    tcp_.async_read_some(FirstBuffers<asio::mutable_buffer>(buffers), Done(std::forward<Handler>(handler)));
  }
  template <class Buffers, class Handler>
  void async_write_some(const Buffers& buffers, Handler&& handler) {
    tcp_.async_write_some(FirstBuffers<asio::const_buffer>(buffers), Done(std::forward<Handler>(handler)));
  }
  template <class Handler>
  friend void async_teardown(beast::role_type role, Stream& stream, Handler&& handler) {
    websocket::async_teardown(role, stream.tcp_.socket(), std::forward<Handler>(handler));
  }

 private:
  Tcp tcp_;
};

}  // namespace carom::studio
