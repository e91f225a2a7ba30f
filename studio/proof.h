// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace carom::studio {

/// SHA-256 (FIPS 180-4).
std::array<std::uint8_t, 32> sha256(std::string_view message);

/// HMAC-SHA256 (RFC 2104), in hex: that of a nonce shows that who made it knows the key, and does not tell it.
std::string hmacSha256(std::string_view key, std::string_view message);

}  // namespace carom::studio
