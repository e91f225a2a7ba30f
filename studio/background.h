// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace carom::studio {

/// A thread of low priority for what nobody waits for: one job at a time, and a newer one ends it. May be used from any
/// thread.
class Background {
 public:
  /// Must not throw; returns soon after its token is stopped.
  using Job = std::function<void(const std::stop_token&)>;

  Background();
  ~Background();  ///< ends the job and waits for that
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Does this next, and ends what is under way.
  void start(Job job);
  /// Ends what is under way.
  void cancel();
  /// Waits until nothing is under way.
  void wait();

 private:
  void run(const std::stop_token& end);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  Job next_;
  std::stop_source stop_;
  bool working_ = false;
  std::jthread thread_;  // last, as it uses the others
};

}  // namespace carom::studio
