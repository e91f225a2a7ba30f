// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "adjoint/base/errors.h"

namespace carom::fuzz {

/// Ends the process when a promise is broken; asserts are not in every build.
inline void require(bool kept, std::string_view promise) {
  if (kept) return;
  std::fprintf(stderr, "broken promise: %.*s\n", static_cast<int>(promise.size()), promise.data());
  std::abort();
}

/// A message is one line that can be read.
inline void requireMessage(const InputError& error) {
  constexpr std::size_t kLongest = 60'000;  // 48 levels of members with long names
  const std::string_view what = error.what();
  require(!what.empty() && what.size() < kLongest, "a message of 1 to 60000 bytes");
  require(what.find('\n') == std::string_view::npos, "a message of one line");
}

}  // namespace carom::fuzz
