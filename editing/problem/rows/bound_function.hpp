// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/motion/motion.h"
#include "editing/motion_function.h"

/// Functions of the motion that the caller brings along. Internal to editing/.
namespace carom::editing_detail {

/// A MotionFunction whose names are looked up.
struct BoundFunction {
  MotionFunction function;
  std::string where;  ///< for errors
  int body = -1;      ///< whose impact or rest it waits for; -1: it goes by the time
  int with = -1;
  double end = 0;  ///< s, up to which it reads the motion, where it waits for nothing

  /// Throws InputError at `where`: without a name or a function, a scale that is not positive, no such body, ...
  BoundFunction(const Scene& scene, const MotionFunction& function, double duration, std::string where);

  bool waits() const { return body >= 0; }
  /// What it waits for, if it is there.
  std::optional<Instant> awaited(const Motion& motion) const;
  /// s, up to when it reads this motion; no further than the motion goes.
  double extentIn(const Motion& motion) const;
  /// Calls it, and checks what comes back. Where the motion does not reach far enough it is `missing`. Throws
  /// ThrownByUser: what the function throws, or an InputError for bodies, events and times that are not there, numbers
  /// that are not finite, and no seeds without a word why.
  RowReading read(const Motion& motion) const;
};

}  // namespace carom::editing_detail
