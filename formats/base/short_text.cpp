// SPDX-License-Identifier: MIT
#include "formats/base/short_text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace carom::formats_detail {

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-12 ? 0.0 : value);
  return text;
}

std::string ellipsized(std::string_view words, std::size_t most) {
  std::size_t letters = 0, cut = words.size();
  for (std::size_t i = 0; i < words.size(); ++i) {
    if ((static_cast<unsigned char>(words[i]) & 0xC0) == 0x80) continue;
    if (letters + 1 == most) cut = i;
    if (++letters > most) return std::string(words.substr(0, cut)) + "\u2026";
  }
  return std::string(words);
}

std::string counted(std::size_t count, const std::string& word, const std::string& plural) {
  return std::to_string(count) + " " + (count == 1 ? word : plural.empty() ? word + "s" : plural);
}

std::string escaped(std::string_view text, std::span<const std::pair<char, const char*>> replacements) {
  std::string out;
  for (const char c : text) {
    const auto found =
        std::find_if(replacements.begin(), replacements.end(), [&](const auto& pair) { return pair.first == c; });
    out += found == replacements.end() ? std::string(1, c) : found->second;
  }
  return out;
}

std::string joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : separator) + word;
  return all;
}

std::string extensionOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

}  // namespace carom::formats_detail
