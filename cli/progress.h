// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace carom::cli {

class Output;

/// One line on standard error that is written over again and again: the phase, how long it has taken, and how far it
/// is. Silent where standard error is no terminal, with --quiet, and in a phase that is over at once.
class Progress {
 public:
  Progress(const Output& out, std::string phase);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// How far it is; may be called as often as one likes.
  void show(const std::string& state);

 private:
  void redraw();

  const std::string phase_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string state_;
  bool shown_ = false, done_ = false;
  std::thread clock_;  // the time runs on where the work says nothing
};

}  // namespace carom::cli
