// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace carom::studio {

/// A command that makes sense, but not now.
class Refusal : public std::runtime_error {
 public:
  Refusal(std::string code, const std::string& message) : std::runtime_error(message), code_(std::move(code)) {}
  const std::string& code() const { return code_; }  ///< word of the protocol: "busy", "stale", "not_held"

 private:
  std::string code_;
};

}  // namespace carom::studio
