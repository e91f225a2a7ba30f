#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace carom {

/// When each body has to be looked at next, earliest first: a heap with one entry a body, which can be moved.
/// Entries of one time come in the order: impacts before horizons, then by body.
class EventQueue {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  explicit EventQueue(std::size_t bodies = 0) : place_(bodies, kNone) {}

  bool empty() const { return heap_.empty(); }
  double time() const { return heap_.front().time; }
  int body() const { return bodyOf(heap_.front()); }

  /// Sets the time of a body; kNever takes the body out.
  void set(int body, double time, bool is_horizon);

  /// Calls f(body) for every entry up to a time, in no particular order.
  template <class F>
  void visitUntil(double time, const F& f) const {
    visitFrom(0, time, f);
  }

 private:
  struct Entry {
    double time;
    std::uint32_t order;  // body, with the highest bit set for a horizon
    bool operator<(const Entry& o) const { return time != o.time ? time < o.time : order < o.order; }
  };
  static constexpr std::size_t kChildren = 4;  // of each place: a flat heap touches less memory
  static constexpr std::uint32_t kHorizon = 0x80000000u, kNone = 0xffffffffu;
  static int bodyOf(const Entry& e) { return static_cast<int>(e.order & ~kHorizon); }
  std::uint32_t& placeOf(const Entry& e) { return place_[e.order & ~kHorizon]; }

  void moveUp(std::size_t i, const Entry& entry);
  void moveDown(std::size_t i, const Entry& entry);
  void put(std::size_t i, const Entry& entry) {
    heap_[i] = entry;
    placeOf(entry) = static_cast<std::uint32_t>(i);
  }

  template <class F>
  void visitFrom(std::size_t i, double time, const F& f) const {
    if (i >= heap_.size() || heap_[i].time > time) return;
    f(bodyOf(heap_[i]));
    for (std::size_t k = 1; k <= kChildren; ++k) visitFrom(kChildren * i + k, time, f);
  }

  std::vector<Entry> heap_;
  std::vector<std::uint32_t> place_;  // in the heap, of each body
};

}  // namespace carom
