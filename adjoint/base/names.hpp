// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace carom::adjoint_detail {

/// The name of an enumerator; `names` has them all in order. Empty for a number that is none of them.
template <class Enum, std::size_t N>
const char* nameIn(const char* const (&names)[N], Enum value) {
  const auto i = static_cast<std::size_t>(value);
  return i < N ? names[i] : "";
}

}  // namespace carom::adjoint_detail
