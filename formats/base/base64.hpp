// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace carom::formats_detail {

/// Bytes as RFC 4648 writes them, with "=" at the end.
std::string base64(std::string_view bytes);
/// The bytes of such a text; none: it is none.
std::optional<std::string> fromBase64(std::string_view text);

}  // namespace carom::formats_detail
