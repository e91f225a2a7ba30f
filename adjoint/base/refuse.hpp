// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>

#include "adjoint/base/errors.h"

namespace carom::adjoint_detail {

/// Throws InputError at `where` with the parts put together, numbers to all their digits.
template <class... Parts>
[[noreturn]] void refuse(const std::string& where, const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  (out << ... << parts);
  throw InputError(where, out.str());
}

}  // namespace carom::adjoint_detail
