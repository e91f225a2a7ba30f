// SPDX-License-Identifier: MIT
#include "python/src/computing.hpp"

#include <atomic>
#include <chrono>
#include <thread>

namespace carom::python {
namespace {

constexpr int kLooks = 300;  // 5 to 10 us

/// Who took the GIL back last after it had computed; null once it has given it away to compute again. That it gave it away for
/// another reason is not seen: then the next one looks in vain, once, as it stands here itself from then on.
std::atomic<PyThreadState*> last_back = nullptr;

void pause() {
#if defined(__SSE2__) && defined(__x86_64__)
  _mm_pause();
#endif
}

}  // namespace

GilFree::GilFree() : thread_(PyEval_SaveThread()) {
  PyThreadState* self = thread_;
  last_back.compare_exchange_strong(self, nullptr);
}

GilFree::~GilFree() {
  for (int k = 0; k < kLooks && last_back.load(std::memory_order_relaxed); ++k) pause();
  try {
    PyEval_RestoreThread(thread_);
  } catch (...) {
    sleepUntilTheProgramEnds();
  }
  last_back = thread_;
}

GilHeld::GilHeld() {
  try {
    state_ = PyGILState_Ensure();
  } catch (...) {
    sleepUntilTheProgramEnds();
  }
}

void sleepUntilTheProgramEnds() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace carom::python
