// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace carom::studio {

/// Bytes compressed as RFC 1951 has it, without a head: what browsers call "deflate-raw".
std::string deflated(std::string_view bytes);

}  // namespace carom::studio
