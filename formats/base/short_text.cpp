// SPDX-License-Identifier: MIT
#include "formats/base/short_text.hpp"

#include <cmath>
#include <cstdio>

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

}  // namespace carom::formats_detail
