// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace carom::adjoint_detail {

/// When each body has to be looked at next, earliest first: one entry a body, which can be changed. A tournament: every
/// inner place of a binary tree holds the earlier of the two entries below it, so a change climbs from its leaf to the
/// root, always in as many steps. Entries of one time come in the order: impacts before horizons, then by body.
class EventQueue {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  explicit EventQueue(std::size_t bodies = 0)
      : leaves_(std::bit_ceil(bodies + 1)), tree_(2 * leaves_, Entry{kNever, kNobody}) {}

  bool empty() const { return tree_[1].time == kNever; }
  double time() const { return tree_[1].time; }
  int body() const { return bodyOf(tree_[1]); }

  /// Sets the time of a body; kNever takes the body out.
  void set(int body, double time, bool is_horizon) {
    const auto b = static_cast<std::uint32_t>(body);
    std::size_t i = leaves_ + b;
    tree_[i] = {time, is_horizon ? b | kHorizon : b};
    while ((i /= 2) > 0) {
      const Entry &left = tree_[2 * i], &right = tree_[2 * i + 1];
      const Entry* earlier = right < left ? &right : &left;
      tree_[i] = *earlier;
    }
  }

  /// Calls f(body) for every entry up to a finite time, in increasing order of bodies.
  template <class F>
  void visitUntil(double time, const F& f) const {
    visitFrom(1, time, f);
  }

 private:
  struct Entry {
    double time;
    std::uint32_t order;  // body, with the highest bit set for a horizon
    // without branches: which entry of two is the earlier one is a toss-up
    bool operator<(const Entry& o) const {
      return bool(int(time < o.time) | (int(time == o.time) & int(order < o.order)));
    }
  };
  static constexpr std::uint32_t kHorizon = 0x80000000u, kNobody = 0xffffffffu;
  static int bodyOf(const Entry& e) { return static_cast<int>(e.order & ~kHorizon); }

  template <class F>
  void visitFrom(std::size_t i, double time, const F& f) const {
    if (tree_[i].time > time) return;
    if (i >= leaves_) {
      f(bodyOf(tree_[i]));
      return;
    }
    visitFrom(2 * i, time, f);
    visitFrom(2 * i + 1, time, f);
  }

  std::size_t leaves_;
  std::vector<Entry> tree_;  // the root is 1, below i are 2 i and 2 i + 1; leaf of body b: leaves_ + b
};

}  // namespace carom::adjoint_detail
