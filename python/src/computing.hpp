// SPDX-License-Identifier: MIT
#pragma once

#include <cxxabi.h>

#include <memory>
#include <utility>

#if defined(__SSE2__) && defined(__x86_64__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

#include "python/src/bindings.hpp"

namespace carom::python {

/// While it lives, this thread and those that it begins compute as IEEE 754 says, whatever its caller has set: JAX calls
/// back with denormal numbers flushed to zero, and then a motion may have other bits. 7 ns; <cfenv> takes 230 ns here, as it
/// sets the arithmetic of the x87 as well, which nothing uses.
class PlainArithmetic {
 public:
#if defined(__SSE2__) && defined(__x86_64__)
  PlainArithmetic() : before_(_mm_getcsr()) { _mm_setcsr(kPlain); }
  ~PlainArithmetic() { _mm_setcsr(before_); }
#else
  PlainArithmetic() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~PlainArithmetic() { std::fesetenv(&before_); }
#endif
  PlainArithmetic(const PlainArithmetic&) = delete;
  PlainArithmetic& operator=(const PlainArithmetic&) = delete;

 private:
#if defined(__SSE2__) && defined(__x86_64__)
  static constexpr unsigned kPlain = 0x1f80;  // rounds to nearest, keeps denormal numbers, traps nothing
  unsigned before_;
#else
  std::fenv_t before_;
#endif
};

/// Gives the GIL away while it lives. Before it sleeps until it is free, it looks for some microseconds whether another such
/// thread gives it away: calls have the GIL for a microsecond or two, but to be put to sleep and woken takes tens of them, and
/// two threads of short calls were slower than one.
class GilFree {
 public:
  GilFree();
  ~GilFree();
  GilFree(const GilFree&) = delete;
  GilFree& operator=(const GilFree&) = delete;

 private:
  PyThreadState* thread_;
};

/// Takes the GIL while it lives, in a call that computes without it.
class GilHeld {
 public:
  GilHeld();
  ~GilHeld() { PyGILState_Release(state_); }
  GilHeld(const GilHeld&) = delete;
  GilHeld& operator=(const GilHeld&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Forever. Where the program ends, Python up to 3.13 unwinds each other thread as it takes the GIL, which ends with an abort in
/// C++ that cannot be unwound; later ones have it sleep, as this does.
[[noreturn]] void sleepUntilTheProgramEnds();

/// Calls a function of Python, with the GIL.
template <class... Arguments>
nb::object calledBack(const nb::object& function, Arguments&&... arguments) {
#ifdef __GLIBCXX__
  try {
    return function(std::forward<Arguments>(arguments)...);
  } catch (const abi::__forced_unwind&) {
    sleepUntilTheProgramEnds();
  }
#else
  return function(std::forward<Arguments>(arguments)...);
#endif
}

/// What every call that computes does first: it gives the GIL away, and computes plainly.
class Computing {
 private:
  GilFree free_;
  PlainArithmetic plain_;
};

/// Shared, and deleted without the GIL where that takes long.
template <class Made>
std::shared_ptr<Made> sharedFreely(std::unique_ptr<Made> made, bool takes_long) {
  return {made.release(), [takes_long](Made* last) {
            if (!takes_long || PyGILState_Check() == 0) return delete last;
            const GilFree free;
            delete last;
          }};
}

}  // namespace carom::python
