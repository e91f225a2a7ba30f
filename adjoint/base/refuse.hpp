// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>

#include "adjoint/base/errors.h"

namespace carom {

/// Throws InputError at `where` with the parts put together, numbers to all their digits.
template <class... Parts>
[[noreturn]] void refuse(const std::string& where, const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  (out << ... << parts);
  throw InputError(where, out.str());
}

/// A number that was computed, to so many digits.
inline std::string about(double value, int digits = 6) {
  std::ostringstream out;
  out.precision(digits);
  out << value;
  return out.str();
}

}  // namespace carom
