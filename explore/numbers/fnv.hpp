// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace carom::explore_detail {

/// 64-bit FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo).
inline std::uint64_t fnv(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return hash;
}

}  // namespace carom::explore_detail
