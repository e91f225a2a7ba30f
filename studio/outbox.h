// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace carom::studio {

/// A message to a page.
struct Outgoing {
  std::function<std::string()> encode;  ///< its bytes; called when it is sent, or never
  std::size_t bytes = 0;                ///< about how many
  bool binary = false;                  ///< a frame, not a text
  /// A motion that a newer one makes needless: it gives way, while it waits.
  bool gives_way = false;
  bool is_motion = false;  ///< makes those needless that wait and give way
};

/// Messages that wait until a socket takes them, oldest first.
class Outbox {
 public:
  Outbox(std::size_t most_messages, std::size_t most_bytes) : most_messages_(most_messages), most_bytes_(most_bytes) {}

  /// False: the page is too slow, and it was not added.
  bool push(Outgoing message) {
    if (message.is_motion)
      for (auto waiting = messages_.begin(); waiting != messages_.end();) {
        if (waiting->gives_way) bytes_ -= waiting->bytes;
        waiting = waiting->gives_way ? messages_.erase(waiting) : waiting + 1;
      }
    if (messages_.size() >= most_messages_ || bytes_ + message.bytes > most_bytes_) return false;
    bytes_ += message.bytes;
    messages_.push_back(std::move(message));
    return true;
  }

  /// The oldest, which leaves; none where there is none.
  std::optional<Outgoing> pop() {
    if (messages_.empty()) return std::nullopt;
    Outgoing message = std::move(messages_.front());
    messages_.pop_front();
    bytes_ -= message.bytes;
    return message;
  }

  bool isEmpty() const { return messages_.empty(); }

 private:
  const std::size_t most_messages_, most_bytes_;
  std::deque<Outgoing> messages_;
  std::size_t bytes_ = 0;
};

}  // namespace carom::studio
