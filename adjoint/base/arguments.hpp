// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "adjoint/base/types.h"

/// Checks of what public functions are given, in every build. Each throws InputError, `where` being the function or the
/// member; what is right costs a comparison. Internal to carom.
namespace carom::adjoint_detail {

[[noreturn]] void refuseIndex(const char* where, const char* what, long long found, std::size_t count);
[[noreturn]] void refuseNumber(const char* where, const char* what, double found, const char* expected);
[[noreturn]] void refuseCount(const char* where, const char* what, std::size_t found, std::size_t expected);

/// The index as a subscript of a list of `count`.
inline std::size_t checkedIndex(const char* where, const char* what, long long index, std::size_t count) {
  if (index < 0 || static_cast<unsigned long long>(index) >= count) refuseIndex(where, what, index, count);
  return static_cast<std::size_t>(index);
}

inline double checkedNumber(const char* where, const char* what, double value) {
  if (!std::isfinite(value)) refuseNumber(where, what, value, "a finite number");
  return value;
}

/// Whatever Eigen object it is.
template <class Numbers>
void checkEntries(const char* where, const char* what, const Numbers& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i) checkedNumber(where, what, values(i));
}

inline void checkCount(const char* where, const char* what, std::size_t found, std::size_t expected) {
  if (found != expected) refuseCount(where, what, found, expected);
}

/// A duration of a motion: 0 to 1e9 s.
void checkDuration(const char* where, double duration);

}  // namespace carom::adjoint_detail
