// SPDX-License-Identifier: MIT
#include "ode_bridge/library.hpp"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <stdexcept>

namespace carom::ode_bridge_detail {
namespace {

// The library's own errors would end the process.
[[noreturn]] void raise(int number, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  throw std::runtime_error("collision library, error " + std::to_string(number) + ": " + text);
}

void initialise() {
  dInitODE2(0);
  dSetErrorHandler(raise);
  dSetDebugHandler(raise);
}

std::once_flag initialised;

}  // namespace

std::unique_lock<std::mutex> lockOde() {
  static std::mutex mutex;
  prepareOdeThread();
  return std::unique_lock(mutex);
}

void prepareOdeThread() {
  std::call_once(initialised, initialise);
  thread_local const int ready = dAllocateODEDataForThread(dAllocateMaskAll);
  (void)ready;
}

}  // namespace carom::ode_bridge_detail
