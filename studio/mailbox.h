// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <utility>
#include <variant>

#include "studio/protocol.h"
#include "studio/socket_id.h"

namespace carom::studio {

/// A command and who sent it.
struct Letter {
  SocketId from = 0;  ///< the socket
  Command command;    ///< what it asks for
};

/// Commands for the thread of the session, in the order in which they came; of the drags of a gesture that wait only the
/// newest is kept, as what the hand wants now. What comes of the commands is what would come of all of them. May be used
/// from any thread.
class Mailbox {
 public:
  /// A socket with so many commands that wait should not be read.
  explicit Mailbox(std::size_t most = 64) : most_(most) {}

  /// Adds a command and stops the work that it interrupts. False: its socket should not be read until `onRoom` says so.
  bool put(Letter letter) {
    const std::lock_guard lock(mutex_);
    dropDragBefore(letter);
    if (interrupts(letter.command)) work_.request_stop();
    if (endsHold(letter.command)) drag_.request_stop();
    rest_.request_stop();
    std::size_t& waiting = waiting_[letter.from];
    ++waiting;
    const bool room = waiting < most_;
    letters_.push_back(std::move(letter));
    filled_.notify_one();
    return room;
  }

  /// The next command; waits for one. None: asked to stop.
  std::optional<Letter> take(std::stop_token stop) {
    std::unique_lock lock(mutex_);
    if (!filled_.wait(lock, std::move(stop), [&] { return !letters_.empty(); })) return std::nullopt;
    Letter letter = std::move(letters_.front());
    letters_.pop_front();
    const bool room = leave(letter.from);
    const SocketId from = letter.from;
    lock.unlock();
    if (room && on_room_) on_room_(from);
    return letter;
  }

  bool isEmpty() const {
    const std::lock_guard lock(mutex_);
    return letters_.empty();
  }

  /// For work that a command stops, but for drags and what only asks; stopped at once where one waits already.
  std::stop_token beginWork() {
    return begin(work_, [](const Letter& letter) { return interrupts(letter.command); });
  }
  /// For one update of a drag, which runs to its end unless what it is for ends.
  std::stop_token beginDrag() {
    return begin(drag_, [](const Letter& letter) { return endsHold(letter.command); });
  }
  /// For work while the hand rests, which any command stops.
  std::stop_token beginRest() {
    return begin(rest_, [](const Letter&) { return true; });
  }
  /// Stops all of them: the program ends.
  void stopAll() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    work_.request_stop();
    drag_.request_stop();
    rest_.request_stop();
  }

  /// Called, by the thread that takes, with a socket that may be read again. To be set before anything is put.
  void onRoom(std::function<void(SocketId)> call) { on_room_ = std::move(call); }

 private:
  template <class Interrupts>
  std::stop_token begin(std::stop_source& source, Interrupts interrupts_it) {
    const std::lock_guard lock(mutex_);
    source = std::stop_source();
    if (closed_ || std::any_of(letters_.begin(), letters_.end(), interrupts_it)) source.request_stop();
    return source.get_token();
  }
  // The drag that waits before a letter, where the letter makes it needless.
  void dropDragBefore(const Letter& letter) {
    const auto old = std::find_if(letters_.rbegin(), letters_.rend(), [&](const Letter& other) {
      return other.from == letter.from && !passesDrags(other.command);
    });
    if (old == letters_.rend()) return;
    const Drag* drag = std::get_if<Drag>(&old->command.what);
    if (drag == nullptr || !makesNeedless(letter.command, *drag)) return;
    letters_.erase(std::next(old).base());
    leave(letter.from);
  }
  // Whether its socket may be read again, which it was not.
  bool leave(SocketId from) {
    const auto waiting = waiting_.find(from);
    const bool was_full = waiting->second >= most_;
    if (--waiting->second == 0) waiting_.erase(waiting);
    return was_full;
  }

  const std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable_any filled_;
  std::deque<Letter> letters_;
  std::map<SocketId, std::size_t> waiting_;
  std::stop_source work_, drag_, rest_;
  bool closed_ = false;
  std::function<void(SocketId)> on_room_;
};

}  // namespace carom::studio
