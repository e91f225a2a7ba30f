// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adjoint/base/types.h"
#include "adjoint/scene/shape.h"

namespace carom {

/// Leaves a component of a target free.
inline constexpr double any = std::numeric_limits<double>::quiet_NaN();

/// When a constraint holds: at a time; just before the body's n-th impact (1 = first), counting only those with `with`
/// when it is not empty; or at some time of a span, which the edit chooses.
struct When {
  double time = 0;
  int impact = 0;  ///< 0: not at an impact
  std::string with;
  std::optional<std::pair<double, double>> span;  ///< s, first and last; at some time in it

  When(double t) : time(t) {}  // NOLINT: nail("hat", 1.4) is how people write it
  When(int n, std::string other) : impact(n), with(std::move(other)) {}
};
inline When nthImpact(int n, std::string with = "") { return When(n, std::move(with)); }
/// At some time in [from, to].
inline When between(double from, double to) {
  When when(from);
  when.span = {from, to};
  return when;
}

/// One target of a constraint. `quantity` is the word of the scene document: position, orientation, velocity,
/// angular_velocity, time, point. `value` holds 3 numbers (`any` leaves one free); for orientation the quaternion
/// w, x, y, z (shape to world); for time 1. A component may be held within a range instead: its `value` is `any` and
/// `min`, `max` (empty, or as many as `value`; `any`: no limit on that side) give the range.
struct Target {
  std::string quantity;
  std::vector<double> value;
  Vec3 body_point = Vec3::Zero();  ///< point: in the shape's axes
  std::vector<double> min = {}, max = {};
};

/// A part of space that the body stays out of, or within, over a span of time: at every moment of it, not only at some.
/// What is kept there is a ball about the body's centre of mass, of radius `margin`.
struct Region {
  enum class Side { avoid, inside };
  Side side = Side::avoid;
  std::variant<Sphere, Box> shape = Sphere{};
  Vec3 position = Vec3::Zero();         ///< of the centre of the region, m, world
  Quat orientation = Quat::Identity();  ///< its axes to world, unit
  /// s, first and last; without it the whole motion.
  std::optional<std::pair<double, double>> during = std::nullopt;
  /// m; without it the radius of a ball that holds the whole body.
  std::optional<double> margin = std::nullopt;
};

struct Constraint {
  std::string body;
  When at;
  std::vector<Target> targets;
  /// Not empty: targets are seen from this body, in its shape's axes (see `seenFrom` in editing/problem/rows/relative.hpp).
  std::string relative_to = {};
  std::vector<Region> regions = {};  ///< whenever `at` is
  std::string notes = {};            ///< for people; kept in documents
};

}  // namespace carom
