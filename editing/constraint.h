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
  double time = 0;   ///< s; first of a span
  int impact = 0;    ///< 0: not at an impact
  std::string with;  ///< body that it meets; empty: any
  std::optional<std::pair<double, double>> span;  ///< s, first and last; at some time in it

  /// At a time, s.
  When(double t) : time(t) {}  // NOLINT: nail("hat", 1.4) is how people write it
  /// Just before the n-th impact, with one body or with any.
  When(int n, std::string other) : impact(n), with(std::move(other)) {}
};
/// Just before the n-th impact of the body (1 = first), with the body `with` or with any.
inline When nthImpact(int n, std::string with = "") { return When(n, std::move(with)); }
/// At some time in [from, to].
inline When between(double from, double to) {
  When when(from);
  when.span = {from, to};
  return when;
}

/// One target of a constraint. `quantity` is the word of the scene document: position, orientation, velocity,
/// angular_velocity, time, point, speed, kinetic_energy, impulse, height. `value` holds 3 numbers (`any` leaves one
/// free); for orientation the quaternion w, x, y, z (shape to world); for time, speed, energy, impulse and height 1. A component may be held within a range instead: its `value` is `any` and
/// `min`, `max` (empty, or as many as `value`; `any`: no limit on that side) give the range.
struct Target {
  std::string quantity;            ///< word of the scene document
  std::vector<double> value;       ///< SI; `any` where free or in a range
  Vec3 body_point = Vec3::Zero();  ///< point: in the shape's axes
  std::vector<double> min = {};    ///< least values, SI
  std::vector<double> max = {};    ///< greatest values, SI
};

/// A part of space that the body stays out of, or within, over a span of time: at every moment of it, not only at some.
/// What is kept there is a ball about the body's centre of mass, of radius `margin`.
struct Region {
  /// Stays out of it, or within it.
  enum class Side { avoid, inside };
  Side side = Side::avoid;                     ///< which of the two
  std::variant<Sphere, Box> shape = Sphere{};  ///< of the region
  Vec3 position = Vec3::Zero();         ///< of the centre of the region, m, world
  Quat orientation = Quat::Identity();  ///< its axes to world, unit
  /// s, first and last; without it the whole motion.
  std::optional<std::pair<double, double>> during = std::nullopt;
  /// m; without it the radius of a ball that holds the whole body.
  std::optional<double> margin = std::nullopt;
};

/// What is asked of one body at one moment.
struct Constraint {
  std::string body;             ///< by name
  When at;                      ///< the moment
  std::vector<Target> targets;  ///< what its numbers shall be then
  /// Not empty: targets are seen from this body, in its shape's axes (docs/scenes.md).
  std::string relative_to = {};
  std::vector<Region> regions = {};  ///< whenever `at` is
  std::string notes = {};            ///< for people; kept in documents
};

}  // namespace carom
