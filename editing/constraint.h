#pragma once

#include <limits>
#include <string>
#include <vector>

#include "adjoint/types.h"

namespace carom {

/// Leaves a component of a target free.
inline constexpr double any = std::numeric_limits<double>::quiet_NaN();

/// When a constraint holds: at a time, or just before the body's n-th impact (1 = first), counting only those with
/// `with` when it is not empty.
struct When {
  double time = 0;
  int impact = 0;  ///< 0: at `time`
  std::string with;

  When(double t) : time(t) {}  // NOLINT: nail("hat", 1.4) is how people write it
  When(int n, std::string other) : impact(n), with(std::move(other)) {}
};
inline When nthImpact(int n, std::string with = "") { return When(n, std::move(with)); }

/// One target of a constraint. `quantity` is the word of the scene document: position, orientation, velocity,
/// angular_velocity, time, point. `value` holds 3 numbers (`any` leaves one free); for orientation the quaternion
/// w, x, y, z (shape to world); for time 1.
struct Target {
  std::string quantity;
  std::vector<double> value;
  Vec3 body_point = Vec3::Zero();  ///< point: in the shape's axes
};

struct Constraint {
  std::string body;
  When at;
  std::vector<Target> targets;
};

}  // namespace carom
