// SPDX-License-Identifier: MIT
#include "cli/progress.h"

#include <cstdio>
#include <iostream>

#include "cli/output.h"
#include "cli/terminal.h"

namespace carom::cli {
namespace {

constexpr auto kFirst = std::chrono::milliseconds(200);
constexpr auto kInterval = std::chrono::milliseconds(100);

}  // namespace

Progress::Progress(const Output& out, std::string phase) : phase_(std::move(phase)) {
  if (out.quiet() || !isTerminal(Stream::error)) return;
  clock_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    for (auto wait = kFirst; !ended_.wait_for(lock, wait, [this] { return done_; }); wait = kInterval) redraw();
  });
}

Progress::~Progress() {
  if (!clock_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_one();
  clock_.join();
  if (shown_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::show(const std::string& state) {
  const std::lock_guard lock(mutex_);
  state_ = state;
}

void Progress::redraw() {
  char seconds[32];
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  std::snprintf(seconds, sizeof seconds, ", %.1f s", elapsed.count());
  const std::string line = phase_ + seconds + (state_.empty() ? "" : ": " + state_);
  std::cerr << '\r' << fitted(line, terminalWidth() - 1) << "\033[K" << std::flush;
  shown_ = true;
}

}  // namespace carom::cli
