// SPDX-License-Identifier: MIT
#include "editing/detail/messages.hpp"

#include <cctype>
#include <cstdio>

namespace carom::editing_detail {

std::string number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

std::string brief(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", value);
  return buffer;
}

std::string briefBeside(double value, double other) {
  char text[32], beside[32];
  for (int digits = 3; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    std::snprintf(beside, sizeof beside, "%.*g", digits, other);
    if (std::string(text) != beside || value == other) break;
  }
  return text;
}

std::string sentence(std::string clause) {
  if (!clause.empty()) clause[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(clause[0])));
  return clause + ".";
}

std::string listOf(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

}  // namespace carom::editing_detail
