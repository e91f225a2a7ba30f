// SPDX-License-Identifier: MIT
#include "cli/output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "adjoint/base/errors.h"
#include "cli/command.h"

namespace carom::cli {

std::string Output::numberOf(int digits, double value) {
  if (!std::isfinite(value)) return "-";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value == 0 ? 0.0 : value);
  return buffer;
}

std::string Output::roundedBeside(double value, double other) const {
  constexpr double kNoDifference = 1e-6;
  std::string text = rounded(value);
  if (std::abs(value - other) <= kNoDifference * std::max(std::abs(value), std::abs(other))) return text;
  for (int digits = kFewDigits; text == rounded(other) && digits < 17; ++digits) {
    if (numberOf(digits, value) != numberOf(digits, other)) return numberOf(digits, value);
  }
  return text;
}

std::string Output::vector(const Vec3& value) const {
  return number(value.x()) + ", " + number(value.y()) + ", " + number(value.z());
}

void Output::reserveForContent() {
  if (json()) throw UsageError("--json and -o - both ask for standard output: expected one of them");
  content_.emplace();
}

void Output::warn(const std::string& sentence) const {
  if (quiet()) return;
  const std::string head = "carom: warning:";
  std::cerr << (hasColours(Stream::error) ? coloured(Look::warning, head) : head) << ' ' << sentence << '\n';
}

void Output::printError(const std::string& sentence) {
  const std::string head = "carom:";
  std::cerr << (hasColours(Stream::error) ? coloured(Look::bad, head) : head) << ' ' << sentence << '\n';
}

void Output::finish() {
  if (json()) {
    std::cout << document_;
  } else if (!quiet()) {
    (content_ ? std::cerr : std::cout) << text_.str();
  }
  if (content_) std::cout << *content_;
  std::cout.flush();
  for (const std::string& sentence : failures_) printError(sentence);
  if (!std::cout) throw InputError("standard output", "cannot be written");
}

std::string describeWanted(const Output& out, double target, double lower, double upper) {
  if (lower == upper) return out.number(target);
  if (std::isinf(upper)) return ">= " + out.number(lower);
  if (std::isinf(lower)) return "<= " + out.number(upper);
  return "in [" + out.number(lower) + ", " + out.number(upper) + "]";
}

}  // namespace carom::cli
