// SPDX-License-Identifier: MIT
#pragma once

#include <signal.h>

#include <atomic>
#include <stop_token>
#include <stdexcept>
#include <thread>

namespace carom::cli {

/// Ctrl-C (SIGINT) and SIGTERM. They end the process as ever, but for work that can be stopped with something to show
/// for it: there the first signal asks it to stop, and the second ends the process. One object, made before any other
/// thread is; it waits for signals in a thread of its own, so that nothing is done in a handler.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that asked work to stop; 0 for none.
  int signal() const { return signal_; }

  /// While it lives, work goes on that asks `token` whether to stop.
  class Stoppable {
   public:
    explicit Stoppable(Interruption& interruption) : interruption_(interruption) { ++interruption_.stoppable_; }
    ~Stoppable() { --interruption_.stoppable_; }
    Stoppable(const Stoppable&) = delete;
    Stoppable& operator=(const Stoppable&) = delete;
    std::stop_token token() const { return interruption_.stop_.get_token(); }

   private:
    Interruption& interruption_;
  };

 private:
  void watch();

  sigset_t watched_, before_;
  int wake_ = 0;  // one of those that are watched; 0: none are
  std::stop_source stop_;
  std::atomic<int> signal_ = 0, stoppable_ = 0;
  std::atomic<bool> done_ = false;
  std::thread watcher_;
};

/// Work was stopped by a signal, and there is nothing to show for it but this sentence.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace carom::cli
