// SPDX-License-Identifier: MIT
#include "studio/net.h"

#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>
#include <limits>
#include <map>
#include <optional>

#include "adjoint/base/errors.h"
#include "studio/net_stream.hpp"
#include "studio/peers.h"

namespace carom::studio {
namespace {

using Clock = std::chrono::steady_clock;
using Timer = asio::basic_waitable_timer<Clock, asio::wait_traits<Clock>, Executor>;
using HttpRequest = http::request<http::empty_body>;

constexpr std::size_t kMostDrained = 4u << 20;       // of a request that was refused, before its connection is closed
constexpr std::chrono::milliseconds kFarewell{500};  // for sockets to close when the program ends
constexpr std::chrono::milliseconds kAcceptAgain{100};  // where the system has no room for a connection

class Socket;

}  // namespace

struct Net::State {
  State(const Limits& the_limits, NetHandlers the_handlers) : limits(the_limits), handlers(std::move(the_handlers)) {}

  void accept();
  void take(TcpSocket socket);
  void stop();
  template <class Call>
  void with(SocketId id, Call call) {
    asio::post(io, [this, id, call = std::move(call)]() mutable {
      const auto found = sockets.find(id);
      if (found != sockets.end()) call(*std::shared_ptr(found->second));  // which may end
    });
  }

  const Limits limits;
  const NetHandlers handlers;
  asio::io_context io{1};
  asio::basic_socket_acceptor<tcp, Executor> acceptor{io};
  Timer timer{io};
  unsigned short port = 0;
  Peers peers;
  std::map<SocketId, std::shared_ptr<Socket>> sockets;
  SocketId next_socket = 1;
  bool stopping = false;
};

namespace {

class Socket final : public Peer, public std::enable_shared_from_this<Socket> {
 public:
  Socket(Net::State& net, Stream stream, SocketId id);
  void start(const HttpRequest& request);
  void drop() override { beast::get_lowest_layer(stream_).close(); }
  void send(Outgoing message);
  void welcome();
  void close(const CloseReason& reason);
  void closeAfter(std::chrono::milliseconds wait, const CloseReason& reason) {
    after(wait, [this, reason] { close(reason); });
  }
  void resume() { paused_ = false, read(); }

 private:
  template <class Call>
  void after(std::chrono::milliseconds wait, Call call);
  void read();
  void onRead(Error error);
  void write();
  void end();

  Net::State& net_;
  websocket::stream<Stream, false> stream_;  // false: without compression, which it never agreed to
  beast::flat_buffer buffer_;
  Timer timer_;
  Outbox outbox_;
  std::string written_;  // what is being written: one at a time
  const SocketId id_;
  bool reading_ = false, paused_ = false, writing_ = false, closing_ = false;
};
Socket::Socket(Net::State& net, Stream stream, SocketId id)
    : net_(net),
      stream_(std::move(stream)),
      timer_(net.io),
      outbox_(net.limits.outbox_messages, net.limits.outbox_bytes),
      id_(id) {
  is_socket = true;
}

void Socket::start(const HttpRequest& request) {
  beast::get_lowest_layer(stream_).expires_never();
  stream_.set_option(websocket::stream_base::timeout{net_.limits.handshake, net_.limits.idle, true});
  stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
    response.set(http::field::server, "carom");  // else it names its library
    for (const auto& [name, value] : securityHeaders("")) response.set(name, value);
  }));
  stream_.read_message_max(net_.limits.first_message);
  stream_.async_accept(request, [self = shared_from_this()](Error error) {
    if (error || self->closing_) return self->end();
    self->closeAfter(self->net_.limits.handshake, {1008, "found no hello in time"});
    self->read();
  });
}

template <class Call>
void Socket::after(std::chrono::milliseconds wait, Call call) {
  timer_.expires_after(wait);
  timer_.async_wait([self = shared_from_this(), call](Error error) {
    if (!error) call();
  });
}

void Socket::welcome() {
  is_known = true;
  timer_.cancel();
  stream_.read_message_max(net_.limits.message);
}

void Socket::read() {
  if (paused_ || reading_ || closing_) return;
  reading_ = true;
  stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) { self->onRead(error); });
}

void Socket::onRead(Error error) {
  reading_ = false;
  if (error) return end();
  if (closing_) return buffer_.clear();
  if (!stream_.got_text()) return close({1003, "found a binary message, expected text"});
  std::string text = beast::buffers_to_string(buffer_.data());
  buffer_.clear();
  paused_ = !net_.handlers.message(id_, std::move(text));
  read();
}

void Socket::send(Outgoing message) {
  if (closing_) return;
  if (!outbox_.push(std::move(message))) return close({1013, "the page is too slow in reading"});
  write();
}

void Socket::write() {
  if (writing_ || closing_) return;
  const std::optional<Outgoing> next = outbox_.pop();
  if (!next) return;
  writing_ = true;
  written_ = next->encode();
  stream_.binary(next->binary);
  stream_.async_write(asio::buffer(written_), [self = shared_from_this()](Error error, std::size_t) {
    self->writing_ = false;
    if (error) return self->drop();  // the read that is under way ends with it
    self->write();
  });
}

void Socket::close(const CloseReason& reason) {
  if (closing_) return;
  closing_ = true;
  // a peer that does not take what is being written never gets to the close
  after(net_.limits.handshake, [this] { drop(); });
  const websocket::close_reason said(static_cast<websocket::close_code>(reason.code), reason.text);
  stream_.async_close(said, [self = shared_from_this()](Error) { self->end(); });
}

void Socket::end() {
  closing_ = true;
  timer_.cancel();
  drop();
  if (net_.sockets.erase(id_) == 0) return;
  net_.handlers.gone(id_);
  if (net_.stopping && net_.sockets.empty()) net_.io.stop();
}

// A connection that speaks HTTP.
class Visitor final : public Peer, public std::enable_shared_from_this<Visitor> {
 public:
  Visitor(Net::State& net, TcpSocket socket) : net_(net), stream_(std::move(socket)) {}
  void read();
  void drop() override { stream_.next_layer().close(); }

 private:
  void onHeader(Error error);
  void refuse(int status, const std::string& sentence) {
    answer({status, "text/plain; charset=utf-8", sentence + "\n", {{"Allow", "GET, HEAD"}}}, false);
  }
  void upgrade();
  void answer(HttpAnswer answer, bool keep);
  void drain();

  Net::State& net_;
  Stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  http::response<http::string_body> response_;
  std::array<char, 16384> drained_;
  std::size_t drained_bytes_ = 0;
};

std::vector<std::string> allOf(const HttpRequest& request, http::field field) {
  std::vector<std::string> values;
  const auto [begin, end] = request.equal_range(field);
  for (auto it = begin; it != end; ++it) values.emplace_back(it->value());
  return values;
}

void Visitor::read() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(net_.limits.header));
  parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // the gate says what of bodies
  stream_.next_layer().expires_after(net_.limits.handshake);
  http::async_read_header(stream_, buffer_, *parser_,
                          [self = shared_from_this()](Error error, std::size_t) { self->onHeader(error); });
}

void Visitor::onHeader(Error error) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return refuse(431, "found a header of more than " + std::to_string(net_.limits.header) + " bytes");
  if (error && error != http::error::end_of_stream && error.category() == Error(http::error::bad_method).category())
    return refuse(400, "found something that is not an HTTP request");
  if (error) return;  // gone, or too slow
  const HttpRequest& request = parser_->get();
  const bool body = parser_->chunked() || parser_->content_length().value_or(0) > 0;
  const Request asked{std::string(request.method_string()), std::string(request.target()),
                      allOf(request, http::field::host),    allOf(request, http::field::origin),
                      websocket::is_upgrade(request),       body,
                      allOf(request, http::field::accept_encoding)};
  const Verdict verdict = judge(asked, net_.port);
  if (verdict.status != 200) return refuse(verdict.status, verdict.sentence);
  if (asked.upgrade) return pathOf(asked.target) == "/socket" ? upgrade() : refuse(404, "found no such socket");
  answer(net_.handlers.answer(asked), request.keep_alive());
}

void Visitor::upgrade() {
  net_.peers.makeRoomForStranger(net_.limits.strangers);
  const SocketId id = net_.next_socket++;
  const auto socket = std::make_shared<Socket>(net_, std::move(stream_), id);
  net_.peers.add(socket);
  net_.sockets[id] = socket;
  socket->start(parser_->get());
}

void Visitor::answer(HttpAnswer answer, bool keep) {
  response_ = {};
  response_.result(static_cast<unsigned>(answer.status));
  for (const auto& [name, value] : securityHeaders("")) response_.set(name, value);
  for (const auto& [name, value] : answer.fields) response_.set(name, value);
  response_.set(http::field::content_type, answer.type);
  response_.keep_alive(keep);
  response_.content_length(answer.body.size());
  const bool head = parser_->is_header_done() && parser_->get().method() == http::verb::head;
  if (!head) response_.body() = std::move(answer.body);
  stream_.next_layer().expires_after(net_.limits.handshake);
  http::async_write(stream_, response_, [self = shared_from_this(), keep](Error error, std::size_t) {
    if (!error) keep ? self->read() : self->drain();
  });
}

// What was not read would make the system tear down the connection before the answer has arrived.
void Visitor::drain() {
  Error ignored;
  stream_.next_layer().socket().shutdown(tcp::socket::shutdown_send, ignored);
  stream_.async_read_some(asio::buffer(drained_), [self = shared_from_this()](Error error, std::size_t bytes) {
    self->drained_bytes_ += bytes;
    if (!error && self->drained_bytes_ <= kMostDrained) self->drain();
  });
}

}  // namespace

void Net::State::take(TcpSocket socket) {
  if (!peers.makeRoom(limits.connections)) return;  // and is closed
  Error ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  const auto visitor = std::make_shared<Visitor>(*this, std::move(socket));
  peers.add(visitor);
  visitor->read();
}

void Net::State::accept() {
  acceptor.async_accept([this](Error error, TcpSocket socket) {
    if (stopping) return;
    if (!error) return take(std::move(socket)), accept();
    timer.expires_after(kAcceptAgain);
    timer.async_wait([this](Error cancelled) {
      if (!cancelled) accept();
    });
  });
}

void Net::State::stop() {
  if (stopping) return;
  stopping = true;
  acceptor.close();
  if (sockets.empty()) return io.stop();
  for (const auto& [id, socket] : sockets) socket->close({1001, "the server ends"});
  timer.expires_after(kFarewell);
  timer.async_wait([this](Error error) {
    if (!error) io.stop();
  });
}

Net::Net(unsigned short port, const Limits& limits, NetHandlers handlers)
    : state_(std::make_unique<State>(limits, std::move(handlers))) {
  try {
    const tcp::endpoint here(asio::ip::address_v4::loopback(), port);
    state_->acceptor.open(here.protocol());
    state_->acceptor.set_option(asio::socket_base::reuse_address(true));
    state_->acceptor.bind(here);
    state_->acceptor.listen();
    state_->port = state_->acceptor.local_endpoint().port();
  } catch (const boost::system::system_error& error) {
    throw InputError("found port " + std::to_string(port) + ", which cannot be had (" + error.code().message() +
                     "), expected one that is free");
  }
  state_->accept();
}

Net::~Net() = default;
unsigned short Net::port() const { return state_->port; }
void Net::run() { state_->io.run(); }
void Net::stop() { asio::post(state_->io, [this] { state_->stop(); }); }

void Net::send(SocketId socket, Outgoing message) {
  state_->with(socket, [message = std::move(message)](Socket& at) mutable { at.send(std::move(message)); });
}

void Net::close(SocketId socket, CloseReason reason, std::chrono::milliseconds after) {
  state_->with(socket, [reason = std::move(reason), after](Socket& at) {
    after.count() > 0 ? at.closeAfter(after, reason) : at.close(reason);
  });
}

void Net::welcome(SocketId socket) { state_->with(socket, std::mem_fn(&Socket::welcome)); }
void Net::resume(SocketId socket) { state_->with(socket, std::mem_fn(&Socket::resume)); }

}  // namespace carom::studio
