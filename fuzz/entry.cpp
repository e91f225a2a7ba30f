// SPDX-License-Identifier: MIT
// What libFuzzer calls; CAROM_FUZZ_TARGET is the name of the reader.
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const carom::fuzz::Target* kTarget = carom::fuzz::targetNamed(CAROM_FUZZ_TARGET);
  static_assert(kTarget != nullptr);
  kTarget->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
