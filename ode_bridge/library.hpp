// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>

namespace carom::ode_bridge_detail {

/// Around calls of the collision library: it is initialised, its data of this thread are there, and its errors are thrown.
/// Those of calls that others in the process make go to the handlers that were set before.
class OdeCalls {
 public:
  OdeCalls();
  ~OdeCalls();
  OdeCalls(const OdeCalls&) = delete;
  OdeCalls& operator=(const OdeCalls&) = delete;
};

/// The same around creation and destruction of its objects, which share state between threads.
class LockedOdeCalls {
 public:
  LockedOdeCalls();

 private:
  OdeCalls calls_;
  std::lock_guard<std::mutex> lock_;
};

}  // namespace carom::ode_bridge_detail
