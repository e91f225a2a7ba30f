// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom::formats_detail {

/// A number as people write it, at most 4 digits.
std::string shortNumber(double value);
/// Words of at most `most` letters, the end cut off for an ellipsis where there are more.
std::string ellipsized(std::string_view words, std::size_t most);
/// "1 word" or "2 words".
std::string counted(std::size_t count, const std::string& word, const std::string& plural = "");
/// The text with others in place of some of its characters.
std::string escaped(std::string_view text, std::span<const std::pair<char, const char*>> replacements);
/// "a, b, c"
std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");
/// The end of a file's name, ".glb", in small letters.
std::string extensionOf(const std::string& path);

}  // namespace carom::formats_detail
