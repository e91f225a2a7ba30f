// SPDX-License-Identifier: MIT
#include "cli/interruption.h"

#include <pthread.h>

namespace carom::cli {
namespace {

/// As if the signal had never been watched.
void endBy(int signal, const sigset_t& watched) {
  ::signal(signal, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &watched, nullptr);
  raise(signal);
}

}  // namespace

Interruption::Interruption() {
  sigemptyset(&watched_);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    // what the process is to ignore (nohup, a job in the background) it goes on to ignore
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    sigaddset(&watched_, signal);
    wake_ = signal;
  }
  if (wake_ == 0) return;
  pthread_sigmask(SIG_BLOCK, &watched_, &before_);
  watcher_ = std::thread([this] { watch(); });
}

Interruption::~Interruption() {
  if (!watcher_.joinable()) return;
  done_ = true;
  pthread_kill(watcher_.native_handle(), wake_);
  watcher_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interruption::watch() {
  for (;;) {
    int signal = 0;
    if (sigwait(&watched_, &signal) != 0) continue;
    if (done_) return;
    if (stoppable_ == 0 || signal_ != 0) endBy(signal, watched_);
    signal_ = signal;
    stop_.request_stop();
  }
}

}  // namespace carom::cli
