// SPDX-License-Identifier: MIT
#include "formats/mesh/obj_text.hpp"

namespace carom::formats_detail {

std::string plainText(std::string_view bytes) {
  constexpr std::string_view kUtf8 = "\xEF\xBB\xBF", kLittle = "\xFF\xFE", kBig = "\xFE\xFF";
  if (bytes.starts_with(kUtf8)) return std::string(bytes.substr(kUtf8.size()));
  const bool little = bytes.starts_with(kLittle);
  if (!little && !bytes.starts_with(kBig)) return std::string(bytes);
  std::string text;
  for (std::size_t i = 2; i + 1 < bytes.size(); i += 2) {
    const auto low = static_cast<unsigned char>(bytes[little ? i : i + 1]), high = static_cast<unsigned char>(bytes[little ? i + 1 : i]);
    text += high == 0 && low < 0x80 ? static_cast<char>(low) : '?';
  }
  return text;
}

}  // namespace carom::formats_detail
