// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "adjoint/motion/motion.h"
#include "adjoint/simulate/event_queue.hpp"

namespace carom::adjoint_detail {

/// The bodies of a scene that go as they go in a motion of nearly the same scene: all but those that differ, and those
/// that meet one of these there, directly or through others. What happens to them is known for as long as none of the
/// rest comes to meet one of them.
class ReusedBodies {
 public:
  /// None.
  ReusedBodies() = default;
  /// `scene`, `plan` and `lowest_bounce` are those of `motion`, which is to be simulated up to `duration`; `known`
  /// outlives this. `met`: bodies that were met by one that is not known; they and those that they meet are not known
  /// either.
  ReusedBodies(const Motion& known, const Motion& motion, double duration, const std::vector<int>& met);

  bool has(int body) const { return body >= 0 && is_known_.size() > index(body) && is_known_[index(body)]; }
  std::size_t count() const;

  /// When the next event comes; kNever where none is left.
  double nextTime() const { return next_ < last_ ? baseline_->events[next_].time : EventQueue::kNever; }
  /// The same of one known body.
  double nextTimeOf(int body) const;
  const Event& next() const { return baseline_->events[next_]; }
  /// The present arc of a known body.
  const Arc& arcOf(int body) const { return line(body).arcs[passed_[index(body)]]; }
  /// The next event has come.
  void pass();

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  const WorldLine& line(int body) const { return baseline_->world_lines[index(body)]; }
  void forgetThoseThatMeet();
  void skip();

  const Motion* baseline_ = nullptr;
  std::vector<char> is_known_;       // a body each
  std::vector<std::size_t> passed_;  // events of each
  std::size_t next_ = 0, last_ = 0;  // events of baseline_
};

}  // namespace carom::adjoint_detail
