// SPDX-License-Identifier: MIT
#include "ode_bridge/library.hpp"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace carom::ode_bridge_detail {
namespace {

thread_local int calls_of_thread = 0;
dMessageFunction* error_before = nullptr;
dMessageFunction* debug_before = nullptr;

/// The library's own handlers end the process.
[[noreturn]] void raise(int number, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  throw std::runtime_error("collision library, error " + std::to_string(number) + ": " + text);
}

/// As the library does where nobody handles it.
void print(const char* kind, int number, const char* format, va_list arguments) {
  std::fprintf(stderr, "\n%s %d: ", kind, number);
  std::vfprintf(stderr, format, arguments);
  std::fputc('\n', stderr);
}

void onError(int number, const char* format, va_list arguments) {
  if (calls_of_thread > 0) raise(number, format, arguments);
  if (error_before) return error_before(number, format, arguments);
  print("ODE Error", number, format, arguments);
  std::exit(1);
}

void onDebug(int number, const char* format, va_list arguments) {
  if (calls_of_thread > 0) raise(number, format, arguments);
  if (debug_before) return debug_before(number, format, arguments);
  print("ODE INTERNAL ERROR", number, format, arguments);
  std::abort();
}

void initialise() {
  dInitODE2(0);
  error_before = dGetErrorHandler(), debug_before = dGetDebugHandler();
  dSetErrorHandler(onError);
  dSetDebugHandler(onDebug);
}

std::once_flag initialised;

std::mutex& odeMutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

OdeCalls::OdeCalls() {
  std::call_once(initialised, initialise);
  thread_local const int ready = dAllocateODEDataForThread(dAllocateMaskAll);
  (void)ready;
  ++calls_of_thread;
}

OdeCalls::~OdeCalls() { --calls_of_thread; }

LockedOdeCalls::LockedOdeCalls() : lock_(odeMutex()) {}

}  // namespace carom::ode_bridge_detail
