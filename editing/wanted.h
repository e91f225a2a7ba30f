// SPDX-License-Identifier: MIT
#pragma once

#include "editing/constraint.h"

namespace carom {

/// What a number of a nail shall be: a value, somewhere in a range, or anything (`any`).
struct Wanted {
  double value = any;  ///< SI; `any` where free or in a range
  double min = any;    ///< of a range, SI; `any` where it is open
  double max = any;    ///< the same

  /// A value.
  Wanted(double v) : value(v) {}  // NOLINT: position(0.1, any, 2) is how people write it
  /// Somewhere in a range.
  Wanted(double from, double to) : min(from), max(to) {}
};

/// Somewhere between two numbers, SI.
inline Wanted within(double min, double max) { return {min, max}; }
/// This or more, SI.
inline Wanted atLeast(double min) { return {min, any}; }
/// This or less, SI.
inline Wanted atMost(double max) { return {any, max}; }

}  // namespace carom
