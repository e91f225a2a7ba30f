// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace carom {

/// Misuse or bad input. `where` is a JSON pointer or an API path ("/bodies/2/mass", "body 'hat'"), empty if the
/// message says it; `what()` holds where, what was found and what was expected.
class InputError : public std::runtime_error {
 public:
  /// what() is "where: message".
  InputError(const std::string& where, const std::string& message)
      : std::runtime_error(where.empty() ? message : where + ": " + message), where_(where), message_(message) {}
  /// For a message that names the place itself.
  explicit InputError(const std::string& message) : InputError("", message) {}

  const std::string& where() const { return where_; }      ///< the place, see above
  const std::string& message() const { return message_; }  ///< what was found and what was expected

 private:
  std::string where_, message_;
};

/// Numerical failure: an overflow, 0/0, or a rotation or an impact search that does not finish within its step limit.
/// A simulation ends there, with MotionStatus::not_computable and this message; derivatives throw it.
class NotComputable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace carom
