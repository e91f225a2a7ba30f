// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "adjoint/base/times.h"
#include "editing/constraint.h"

namespace carom {

/// Target of one component of a nail: a value, a range, or free (`any`).
struct Wanted {
  TargetNumber value = any;  ///< SI; `any` if free or in a range
  TargetNumber min = any;    ///< lower bound, SI; `any` if none
  TargetNumber max = any;    ///< upper bound, SI; `any` if none

  /// A value.
  Wanted(double v) : value(v) {}  // NOLINT: for position(0.1, any, 2)
  /// Neither a bool nor a character is a number of a target, least of all a time.
  template <NoTime T>
  Wanted(T v) = delete;
  /// Free.
  Wanted(Free) {}  // NOLINT: likewise
  /// A range.
  Wanted(TargetNumber from, TargetNumber to) : min(from), max(to) {}
};

/// Targets of the three components of a vector.
struct WantedVector {
  Wanted x;  ///< of its x
  Wanted y;  ///< of its y
  Wanted z;  ///< of its z

  /// Component by component: {5, any, within(0, 1)}.
  WantedVector(Wanted of_x, Wanted of_y, Wanted of_z) : x(of_x), y(of_y), z(of_z) {}
  /// A vector of values.
  WantedVector(const Vec3& v) : x(v.x()), y(v.y()), z(v.z()) {}  // NOLINT: for position(p)
};

/// The target of a constraint on a vector: targetOf("position", {5, any, within(0, 1)}).
Target targetOf(std::string quantity, const WantedVector& wanted);
/// The same of a quantity that is one number: targetOf("speed", atMost(3)).
Target targetOf(std::string quantity, const Wanted& wanted);

/// At least `min` and at most `max`, SI.
inline Wanted within(double min, double max) { return {min, max}; }
/// Neither a bool nor a character is a bound.
template <class From, class To>
  requires(NoTime<From> || NoTime<To>)
Wanted within(From min, To max) = delete;
/// At least this, SI.
inline Wanted atLeast(double min) { return {min, any}; }
/// The same.
template <NoTime T>
Wanted atLeast(T min) = delete;
/// At most this, SI.
inline Wanted atMost(double max) { return {any, max}; }
/// The same.
template <NoTime T>
Wanted atMost(T max) = delete;

}  // namespace carom
