// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace carom::formats_detail {

/// A text as bytes that the parser reads: without a byte order mark, and UTF-16 as ASCII, with "?" in place of what is
/// not (names and comments alone have such).
std::string plainText(std::string_view bytes);

}  // namespace carom::formats_detail
