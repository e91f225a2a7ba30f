// SPDX-License-Identifier: MIT
#include "python/src/interruptible.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "python/src/bindings.hpp"

namespace carom::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{10};  // a look takes some microseconds

thread_local int callbacks = 0;

/// Work in a thread of its own, and what it threw.
class Worker {
 public:
  explicit Worker(const std::function<void()>& work) : thread_([this, &work] { run(work); }) {}
  ~Worker() { thread_.join(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Whether it ended within the time.
  bool endsWithin(std::chrono::milliseconds time) {
    std::unique_lock lock(guard_);
    return ended_.wait_for(lock, time, [this] { return done_; });
  }
  const std::exception_ptr& thrown() const { return thrown_; }  // once it has ended

 private:
  void run(const std::function<void()>& work) {
    try {
      work();
    } catch (...) {
      thrown_ = std::current_exception();
    }
    const std::lock_guard lock(guard_);
    done_ = true;
    ended_.notify_one();
  }

  std::mutex guard_;
  std::condition_variable ended_;
  bool done_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;  // begins last
};

/// The error of Python's signal handlers, if one raised; without the GIL.
std::exception_ptr signalled() {
  const GilHeld held;
  if (PyErr_CheckSignals() == 0) return nullptr;
  return std::make_exception_ptr(nb::python_error());
}

}  // namespace

void Watch::look(const SimulateProgress& at) {
  const GilHeld held;
  try {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (progress_.is_valid() && !progress_.is_none() && calledBack(progress_, at).is(nb::bool_(false))) stop_.request_stop();
  } catch (...) {
    raised_ = std::current_exception();
    stop_.request_stop();
  }
}

void runInterruptible(std::stop_source& stop, const std::function<void()>& work) {
  std::exception_ptr raised;
  {
    const Computing free;
    Worker worker(work);
    while (!worker.endsWithin(kBetweenLooks)) {
      if (raised) continue;
      raised = signalled();
      if (raised) stop.request_stop();
    }
    if (!raised) raised = worker.thrown();
  }
  if (raised) std::rethrow_exception(raised);
}

OneAtATime::Use::Use(const OneAtATime& of, const char* what) : of_(of) {
  if (of.in_use_.exchange(true)) throw std::runtime_error(std::string(what) + " is in use by another call");
}

InCallback::InCallback() { ++callbacks; }
InCallback::~InCallback() { --callbacks; }
void InCallback::refuse() {
  if (callbacks > 0) throw std::runtime_error("a callback of an edit must not solve another edit");
}

}  // namespace carom::python
