// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace carom::studio {

/// A socket, by a number that is given once.
using SocketId = std::uint64_t;

}  // namespace carom::studio
