// SPDX-License-Identifier: MIT
#include "cli/output.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "adjoint/errors.h"

namespace carom::cli {
namespace {

constexpr double kProgressInterval = 0.1;  // s

// Characters, not bytes: names may be in any script.
std::size_t widthOf(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

std::string Output::number(double value) const {
  if (!std::isfinite(value)) return "-";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits_, value == 0 ? 0.0 : value);
  return buffer;
}

std::string Output::vector(const Vec3& value) const {
  return number(value.x()) + ", " + number(value.y()) + ", " + number(value.z());
}

void Output::warn(const std::string& sentence) { std::cerr << "carom: warning: " << sentence << '\n'; }

void Output::finish() {
  std::cout << (json_ ? document_ : text_.str());
  std::cout.flush();
  if (!std::cout) throw InputError("standard output", "cannot be written");
}

std::string describeWanted(const Output& out, double target, double lower, double upper) {
  if (lower == upper) return out.number(target);
  if (std::isinf(upper)) return ">= " + out.number(lower);
  if (std::isinf(lower)) return "<= " + out.number(upper);
  return "in [" + out.number(lower) + ", " + out.number(upper) + "]";
}

std::string counted(long long count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

Table::Table(std::vector<std::string> headings) {
  for (std::string& heading : headings) {
    right_.push_back(heading.starts_with('>'));
    if (right_.back()) heading.erase(0, 1);
  }
  rows_.push_back(std::move(headings));
}

void Table::print(std::ostream& out) const {
  std::vector<std::size_t> widths(right_.size(), 0);
  for (const auto& row : rows_)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], widthOf(row[c]));
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - widthOf(row[c]), ' ');
      line += "  " + (right_[c] ? padding + row[c] : row[c] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out << line << '\n';
  }
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::show(const std::string& line) {
  if (!terminal_) return;
  const double now = secondsNow();
  if (now < next_) return;
  next_ = now + kProgressInterval;
  shown_ = true;
  std::cerr << '\r' << line << "\033[K" << std::flush;
}

}  // namespace carom::cli
