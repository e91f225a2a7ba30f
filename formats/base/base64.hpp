// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace carom::formats_detail {

/// Bytes as RFC 4648 writes them, with "=" at the end.
std::string base64(std::string_view bytes);

}  // namespace carom::formats_detail
