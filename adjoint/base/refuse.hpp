// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>

#include "adjoint/base/errors.h"
#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

/// The parts put together, numbers to so many digits.
template <class... Parts>
std::string textOf(int digits, const Parts&... parts) {
  std::ostringstream out;
  out.precision(digits);
  (out << ... << parts);
  return out.str();
}

/// Throws InputError at `where` with the parts put together, numbers to all their digits.
template <class... Parts>
[[noreturn]] void refuse(const std::string& where, const Parts&... parts) {
  throw InputError(where, textOf(17, parts...));
}

/// A number that was computed, to so many digits.
inline std::string about(double value, int digits = 6) { return textOf(digits, value); }

/// "(0.1, 2, -3)", to three digits.
inline std::string aboutPlace(const Vec3& p) { return textOf(3, "(", p.x(), ", ", p.y(), ", ", p.z(), ")"); }

}  // namespace carom::adjoint_detail
