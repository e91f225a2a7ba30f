// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace carom::studio {

/// Bytes compressed as RFC 1951 has it, without a head: what browsers call "deflate-raw". `level`: 1 is quick, 9 small.
std::string deflated(std::string_view bytes, int level = 9);
/// The same as a gzip file (RFC 1952) without a name.
std::string gzipped(std::string_view bytes, int level);

}  // namespace carom::studio
