// SPDX-License-Identifier: MIT
#include "studio/background.h"

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace carom::studio {
namespace {

/// So that what a hand waits for goes first: of the scale of nice.
constexpr int kLowPriority = 10;

}  // namespace

Background::Background() : thread_([this](const std::stop_token& end) { run(end); }) {}

Background::~Background() {
  cancel();
  thread_.request_stop();
}

void Background::start(Job job) {
  const std::lock_guard lock(mutex_);
  stop_.request_stop();
  stop_ = std::stop_source();
  next_ = std::move(job);
  changed_.notify_all();
}

void Background::cancel() {
  const std::lock_guard lock(mutex_);
  stop_.request_stop();
  next_ = nullptr;
  changed_.notify_all();
}

void Background::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !working_ && !next_; });
}

void Background::run(const std::stop_token& end) {
  // of Linux, where each thread has its own; elsewhere it stays as it is
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kLowPriority);
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, end, [&] { return static_cast<bool>(next_); })) {
    const Job job = std::exchange(next_, nullptr);
    const std::stop_token stop = stop_.get_token();
    working_ = true;
    lock.unlock();
    if (!stop.stop_requested()) job(stop);
    lock.lock();
    working_ = false;
    changed_.notify_all();
  }
}

}  // namespace carom::studio
