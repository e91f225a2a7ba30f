// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "adjoint/base/types.h"
#include "cli/interruption.h"
#include "cli/terminal.h"
#include "formats/base/short_text.hpp"

namespace carom::cli {

/// Options that every command has.
struct Settings {
  bool json = false, quiet = false;
  std::optional<int> digits;  ///< not given: what suits the number
};

/// What a command says. Standard output gets either text for people, or with --json one document, or with `-o -` the
/// content of a file; it is written when the command is done, so that a command that fails leaves it empty. Text that
/// gives way to a file, warnings and progress go to standard error.
class Output {
 public:
  Output(const Settings& settings, Interruption& interruption) : settings_(settings), interruption_(interruption) {}

  bool json() const { return settings_.json; }
  bool quiet() const { return settings_.quiet; }
  /// The signals that people end a command with.
  Interruption& interruption() const { return interruption_; }
  /// Whether text for people is coloured.
  bool colours() const { return hasColours(content_ ? Stream::error : Stream::out); }

  /// The document that --json asks for.
  void document(std::string json) { document_ = std::move(json); }
  /// Standard output is for the content of a file. Before any text. Throws UsageError with --json.
  void reserveForContent();
  void content(std::string bytes) { content_ = std::move(bytes); }
  /// Text for people; dropped with --json and --quiet.
  std::ostream& text() { return text_; }
  /// The text in colour where people see colours.
  std::string styled(Look look, const std::string& text) const { return colours() ? coloured(look, text) : text; }

  /// For people, with as many digits as they asked for; "-" where there is no number.
  std::string number(double value) const { return numberOf(settings_.digits.value_or(kDigits), value); }
  /// Of answers that are read, not used: three digits, or as many as were asked for.
  std::string rounded(double value) const { return numberOf(settings_.digits.value_or(kFewDigits), value); }
  /// The same, with as many digits as it takes to tell it from another number that stands beside it, unless they differ by
  /// less than anyone would call a difference.
  std::string roundedBeside(double value, double other) const;
  /// The same with three digits, where more mean nothing.
  static std::string brief(double value) { return numberOf(kFewDigits, value); }
  /// With all digits.
  static std::string full(double value) { return numberOf(17, value); }
  /// "1, 0, 0"
  std::string vector(const Vec3& value) const;

  /// "carom: warning: ..." on standard error, but not with --quiet.
  void warn(const std::string& sentence) const;
  /// What went wrong: on standard error, below all that standard output says of it.
  void fail(std::string sentence) { failures_.push_back(std::move(sentence)); }
  /// "carom: ..." on standard error, at once.
  static void printError(const std::string& sentence);
  /// Writes standard output. Throws InputError when that cannot be done.
  void finish();

 private:
  static constexpr int kDigits = 6, kFewDigits = 3;
  static std::string numberOf(int digits, double value);

  Settings settings_;
  Interruption& interruption_;
  std::string document_;
  std::optional<std::string> content_;
  std::ostringstream text_;
  std::vector<std::string> failures_;
};

/// What a held number is to be: `target`, or where the limits differ "in [0.2, 0.9]", ">= 0.2", "<= 0.9".
std::string describeWanted(const Output& out, double target, double lower, double upper);

}  // namespace carom::cli
