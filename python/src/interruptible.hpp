// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <stop_token>

#include "adjoint/base/work_count.h"
#include "python/src/bindings.hpp"
#include "python/src/computing.hpp"

namespace carom::python {

/// Throws TypeError unless an argument is a function, or None.
inline void requireFunction(const nb::object& argument, const char* name) {
  if (!argument.is_none() && PyCallable_Check(argument.ptr()) == 0)
    throw nb::type_error((std::string(name) + ": expected a function or None").c_str());
}

/// Looks for Ctrl-C while a simulation runs in this thread, and tells its progress to a function of Python, or None. What
/// is raised meanwhile stops it. It costs nothing: a simulation calls it every few thousand steps. Without a function (a null
/// object) it may be made and destroyed without the GIL.
class Watch {
 public:
  explicit Watch(nb::object progress = nb::none()) : progress_(std::move(progress)) {}

  std::stop_token stop() const { return stop_.get_token(); }  ///< of the simulation
  std::function<void(const SimulateProgress&)> progress() {   ///< of the simulation, without the GIL
    return [this](const SimulateProgress& at) { look(at); };
  }
  /// After the simulation, with the GIL: throws what was raised.
  void finish() {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  void look(const SimulateProgress& at);

  nb::object progress_;
  std::stop_source stop_;
  std::exception_ptr raised_;
};

/// Does the work in a thread of its own, without the GIL, and looks for Ctrl-C meanwhile: that asks `stop` to end the
/// work, and is raised after it. What the work throws is thrown here. Call it with the GIL.
void runInterruptible(std::stop_source& stop, const std::function<void()>& work);

/// What one call at a time may use. A second one, of another thread or from a callback, throws RuntimeError instead of
/// waiting for itself.
class OneAtATime {
 public:
  /// While it lives, the thing is in use; `what` names it.
  class Use {
   public:
    Use(const OneAtATime& of, const char* what);
    ~Use() { of_.in_use_ = false; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    const OneAtATime& of_;
  };

  bool isInUse() const { return in_use_; }

 private:
  mutable std::atomic<bool> in_use_ = false;
};

/// While it lives, this thread is in a callback of an edit, which must not solve another one: the solver may wait for it.
class InCallback {
 public:
  InCallback();
  ~InCallback();
  InCallback(const InCallback&) = delete;
  InCallback& operator=(const InCallback&) = delete;
  /// Throws RuntimeError in a callback.
  static void refuse();
};

}  // namespace carom::python
