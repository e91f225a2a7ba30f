// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carom::formats_detail {

/// A number as people write it, at most 4 digits.
std::string shortNumber(double value);
/// Words of at most `most` letters, the end cut off for an ellipsis where there are more.
std::string ellipsized(std::string_view words, std::size_t most);

}  // namespace carom::formats_detail
