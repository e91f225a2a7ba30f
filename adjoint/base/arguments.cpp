// SPDX-License-Identifier: MIT
#include "adjoint/base/arguments.hpp"

#include "adjoint/base/refuse.hpp"

namespace carom::adjoint_detail {

void refuseIndex(const char* where, const char* what, long long found, std::size_t count) {
  if (count == 0) refuse(where, "found ", what, " ", found, ", expected none: there are none");
  refuse(where, "found ", what, " ", found, ", expected one from 0 to ", count - 1);
}

void refuseNumber(const char* where, const char* what, double found, const char* expected) {
  refuse(where, "found ", what, " ", found, ", expected ", expected);
}

void refuseCount(const char* where, const char* what, std::size_t found, std::size_t expected) {
  refuse(where, "found ", found, " ", what, ", expected ", expected);
}

void checkDuration(const char* where, double duration) {
  if (!(duration >= 0 && duration <= 1e9))
    refuse(where, "found a duration of ", duration, " s, expected a finite number >= 0, at most 1e9");
}

}  // namespace carom::adjoint_detail
