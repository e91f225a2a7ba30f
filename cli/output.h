// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "adjoint/types.h"

namespace carom::cli {

/// What a command says. Standard output gets either text for people or, with --json, one document; it is written when
/// the command is done, so that a command that fails leaves it empty. Warnings and progress go to standard error.
class Output {
 public:
  Output(bool json, int digits) : json_(json), digits_(digits) {}

  bool json() const { return json_; }
  /// The document that --json asks for.
  void document(std::string json) { document_ = std::move(json); }
  /// Text for people; dropped with --json.
  std::ostream& text() { return text_; }
  /// For people, with as many digits as they asked for; "-" where there is no number.
  std::string number(double value) const;
  /// "1, 0, 0"
  std::string vector(const Vec3& value) const;

  static void warn(const std::string& sentence);
  /// Writes standard output. Throws InputError when that cannot be done.
  void finish();

 private:
  bool json_;
  int digits_;
  std::string document_;
  std::ostringstream text_;
};

/// What a held number is to be: `target`, or where the limits differ "in [0.2, 0.9]", ">= 0.2", "<= 0.9".
std::string describeWanted(const Output& out, double target, double lower, double upper);

/// "1 impact", "3 impacts".
std::string counted(long long count, const std::string& noun);

/// Rows of text in aligned columns. Columns whose heading starts with '>' stand to the right, without that sign.
class Table {
 public:
  explicit Table(std::vector<std::string> headings);
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.size() == 1; }
  void print(std::ostream& out) const;

 private:
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;  // the headings first
};

/// One line on standard error that is written over again and again; silent where that is not a terminal.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void show(const std::string& line);

 private:
  bool terminal_;
  bool shown_ = false;
  double next_ = 0;  // s, so that a fast loop does not only write
};

}  // namespace carom::cli
