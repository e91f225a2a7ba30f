// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <stop_token>
#include <utility>

namespace carom {

/// How far a simulation is.
struct SimulateProgress {
  double time = 0;          ///< s, everything before it is known
  std::size_t impacts = 0;  ///< so far
  std::size_t steps = 0;    ///< of work so far
};

/// What ends a simulation before its time: its limit of work was reached, or it was asked to stop. No error, and none
/// of the exceptions that say what is wrong with a scene.
struct WorkEnded {
  bool stopped = false;
};

/// Counts the steps of work of one simulation: the same number for the same scene, on any machine. Every so many steps
/// it looks whether it was asked to stop, and reports.
class WorkCount {
 public:
  WorkCount(std::size_t limit, std::stop_token stop, std::function<void(const SimulateProgress&)> report)
      : limit_(limit), stop_(std::move(stop)), report_(std::move(report)) {}

  /// Throws WorkEnded at the limit and soon after a stop was asked for, and from then on every time.
  void step(std::size_t steps = 1) {
    steps_ = steps < kMost - steps_ ? steps_ + steps : kMost;
    if (steps_ >= next_look_) look();
  }
  /// Looks at once.
  void look() {
    if (stop_.stop_requested()) throw WorkEnded{true};
    if (steps_ > limit_) throw WorkEnded{false};
    if (report_ && steps_ >= next_report_) {
      report_({time_, impacts_, steps_});
      next_report_ = steps_ + kReport;
    }
    next_look_ = limit_ < steps_ + kLook ? limit_ + 1 : steps_ + kLook;
  }
  /// What is reported from now on.
  void reached(double time, std::size_t impacts) {
    time_ = time;
    impacts_ = impacts;
  }
  /// After the end: so many more steps, whether or not it was asked to stop, to bring what is known into order.
  void allowMore(std::size_t steps) {
    stop_ = {};
    report_ = nullptr;
    limit_ = steps_ + steps;
    next_look_ = 0;
  }

  std::size_t steps() const { return steps_; }
  std::size_t limit() const { return limit_; }

 private:
  static constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max() / 2;
  static constexpr std::size_t kLook = 128, kReport = 4096;  // steps: a step takes some microseconds

  std::size_t steps_ = 0, limit_, next_look_ = 0, next_report_ = kReport;
  double time_ = 0;
  std::size_t impacts_ = 0;
  std::stop_token stop_;
  std::function<void(const SimulateProgress&)> report_;
};

}  // namespace carom
