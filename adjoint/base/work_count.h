// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <stop_token>
#include <utility>

namespace carom {

/// Progress of a simulation.
struct SimulateProgress {
  double time = 0;          ///< s, the motion is known up to here
  std::size_t impacts = 0;  ///< so far
  std::size_t steps = 0;    ///< counted so far, see WorkCount
};

/// Ends a simulation early: its step limit was reached, or a stop was requested. Not an error, and not derived from
/// the exceptions for invalid scenes.
struct WorkEnded {
  bool stopped = false;  ///< a stop was requested; otherwise the limit was reached
};

/// Counts the work of one simulation in steps (see SimulateOptions::step_limit): the same number for the same scene
/// on any machine. Periodically polls the stop token and reports progress.
class WorkCount {
 public:
  /// At most `limit` steps; `report` may be empty.
  WorkCount(std::size_t limit, std::stop_token stop, std::function<void(const SimulateProgress&)> report)
      : limit_(limit), stop_(std::move(stop)), report_(std::move(report)) {}

  /// Throws WorkEnded at the limit and soon after a stop was requested, and in every later call.
  void step(std::size_t steps = 1) {
    steps_ = steps < kMost - steps_ ? steps_ + steps : kMost;
    if (steps_ >= next_look_) look();
  }
  /// Polls at once.
  void look() {
    if (stop_.stop_requested()) throw WorkEnded{true};
    if (steps_ > limit_) throw WorkEnded{false};
    if (report_ && steps_ >= next_report_) {
      report_({time_, impacts_, steps_});
      next_report_ = steps_ + kReport;
    }
    next_look_ = limit_ < steps_ + kLook ? limit_ + 1 : steps_ + kLook;
  }
  /// The motion time and impacts to report from now on.
  void reached(double time, std::size_t impacts) {
    time_ = time;
    impacts_ = impacts;
  }
  /// After the end: grants so many more steps, regardless of a stop request, to complete the known part of the
  /// motion.
  void allowMore(std::size_t steps) {
    stop_ = {};
    report_ = nullptr;
    limit_ = steps_ + steps;
    next_look_ = 0;
  }

  std::size_t steps() const { return steps_; }  ///< counted so far
  std::size_t limit() const { return limit_; }  ///< greatest number of steps

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
