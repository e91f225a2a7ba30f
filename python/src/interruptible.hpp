// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <stop_token>

namespace carom::python {

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
