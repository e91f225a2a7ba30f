// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace carom::studio {

/// A connection, as far as their number is limited.
class Peer {
 public:
  Peer() = default;
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual void drop() = 0;  ///< closes it at once
  bool is_socket = false;   ///< no longer speaks HTTP
  bool is_known = false;    ///< has said hello: it is never dropped for others
};

/// All connections that are open. Where there are too many, the oldest that is not known gives way, so that clients
/// that only hold connections open keep nobody out.
class Peers {
 public:
  void add(const std::shared_ptr<Peer>& peer) { peers_[next_++] = peer; }

  /// Makes room for one more of at most so many. False: all are known, and there is none.
  bool makeRoom(std::size_t most) {
    return makeRoomAmong(living([](const Peer&) { return true; }), most);
  }
  /// The same for a socket that has not said hello.
  void makeRoomForStranger(std::size_t most) {
    makeRoomAmong(living([](const Peer& peer) { return peer.is_socket && !peer.is_known; }), most);
  }

 private:
  using Living = std::vector<std::pair<std::uint64_t, std::shared_ptr<Peer>>>;

  template <class Counts>
  Living living(Counts counts) {
    std::erase_if(peers_, [](const auto& entry) { return entry.second.expired(); });
    Living found;
    for (const auto& [number, weak] : peers_)
      if (std::shared_ptr<Peer> peer = weak.lock(); peer && counts(*peer)) found.emplace_back(number, std::move(peer));
    return found;
  }
  bool makeRoomAmong(const Living& those, std::size_t most) {
    if (those.size() < most) return true;
    for (const auto& [number, peer] : those) {
      if (peer->is_known) continue;
      peers_.erase(number);
      peer->drop();
      return true;
    }
    return false;
  }

  std::map<std::uint64_t, std::weak_ptr<Peer>> peers_;  // oldest first
  std::uint64_t next_ = 0;
};

}  // namespace carom::studio
