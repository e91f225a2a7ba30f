// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace carom {

/// Misuse or bad input. `where` is a JSON pointer or an API path ("/bodies/2/mass", "body 'hat'"), empty when it is
/// plain from the message; `what()` holds where, what was found and what was expected.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& where, const std::string& message)
      : std::runtime_error(where.empty() ? message : where + ": " + message), where_(where), message_(message) {}
  explicit InputError(const std::string& message) : InputError("", message) {}

  const std::string& where() const { return where_; }
  const std::string& message() const { return message_; }

 private:
  std::string where_, message_;
};

/// The numbers of a scene went where doubles do not follow: an overflow, 0/0, or a rotation or an approach that would
/// take more steps than there is time for. A simulation ends there, with MotionStatus::not_computable and this
/// sentence; derivatives throw it.
class NotComputable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace carom
