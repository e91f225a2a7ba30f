// SPDX-License-Identifier: MIT
#pragma once

#include "editing/constraint.h"

namespace carom {

/// What a number of a nail shall be: a value, somewhere in a range, or anything (`any`).
struct Wanted {
  double value = any;
  double min = any, max = any;  ///< of a range; `any` on a side that is open

  Wanted(double v) : value(v) {}  // NOLINT: position(0.1, any, 2) is how people write it
  Wanted(double from, double to) : min(from), max(to) {}
};

inline Wanted within(double min, double max) { return {min, max}; }
inline Wanted atLeast(double min) { return {min, any}; }
inline Wanted atMost(double max) { return {any, max}; }

}  // namespace carom
