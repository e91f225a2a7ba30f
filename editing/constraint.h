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
/// when it is not empty; at some time of a span, which the edit chooses; or when the body has come to rest.
struct When {
  double time = 0;   ///< s; first of a span
  int impact = 0;    ///< 0: not at an impact
  std::string with;  ///< body that it meets; empty: any
  std::optional<std::pair<double, double>> span;  ///< s, first and last; at some time in it
  bool rest = false;  ///< from when on the body rests up to the end of the motion, whenever that is

  /// At a time, s.
  When(double t) : time(t) {}  // NOLINT: nail("hat", 1.4) is how people write it
  /// Just before the n-th impact, with one body or with any.
  When(int n, std::string other) : impact(n), with(std::move(other)) {}
  /// At a time that is given.
  bool isTime() const { return impact == 0 && !span && !rest; }
};
/// Just before the n-th impact of the body (1 = first), with the body `with` or with any.
inline When nthImpact(int n, std::string with = "") { return When(n, std::move(with)); }
/// At some time in [from, to].
inline When between(double from, double to) {
  When when(from);
  when.span = {from, to};
  return when;
}
/// When the body has come to rest, where it stays up to the end of the motion.
inline When atRest() {
  When when(0);
  when.rest = true;
  return when;
}

/// One target of a constraint. `quantity` is the word of the scene document: position, orientation, velocity,
/// angular_velocity, time, point, speed, kinetic_energy, impulse, height, distance, closest_approach. `value` holds 3
/// numbers (`any` leaves one free); for orientation the quaternion w, x, y, z (shape to world); from time on 1, but for
/// point. A component may be held within a range instead: its `value` is `any` and `min`, `max` (empty, or as many as
/// `value`; `any`: no limit on that side) give the range.
struct Target {
  std::string quantity;            ///< word of the scene document
  std::vector<double> value;       ///< SI; `any` where free or in a range
  Vec3 body_point = Vec3::Zero();  ///< point: in the shape's axes
  std::vector<double> min = {};    ///< least values, SI
  std::vector<double> max = {};    ///< greatest values, SI
  std::string to = {};             ///< distance, closest_approach: name of the other body
  /// closest_approach: s, first and last; without it the whole motion.
  std::optional<std::pair<double, double>> during = std::nullopt;
};

/// A part of space that the body stays out of, or within, over a span of time: at every moment of it, not only at some.
struct Region {
  /// Stays out of it, or within it.
  enum class Side { avoid, inside };
  /// What of the body is kept there.
  enum class Keep {
    ball,  ///< a ball about its centre of mass
    shape  ///< its shape, however it turns
  };
  Side side = Side::avoid;                     ///< which of the two
  std::variant<Sphere, Box> shape = Sphere{};  ///< of the region
  Vec3 position = Vec3::Zero();         ///< of the centre of the region, m, world
  Quat orientation = Quat::Identity();  ///< its axes to world, unit
  /// s, first and last; without it the whole motion.
  std::optional<std::pair<double, double>> during = std::nullopt;
  /// m; of a ball its radius, without it that of one that holds the whole body. Of a shape how far it stays from the
  /// border of the region, without it 0.
  std::optional<double> margin = std::nullopt;
  Keep keep = Keep::ball;  ///< the ball or the shape
};

/// The n-th impact of a body (1 = first), counting only those with `with` when it is not empty.
struct ImpactOf {
  std::string body;       ///< by name
  int n = 1;              ///< which of them
  std::string with = {};  ///< body that it meets; empty: any
};

/// That a body hits another one: the first impact of the two that is allowed. Where the motion has none in `during` but
/// has one beside it, that one is moved there.
struct Hit {
  std::string with;  ///< the other body, by name
  /// s, first and last time; without it at any time.
  std::optional<std::pair<double, double>> during = std::nullopt;
  std::optional<ImpactOf> after = std::nullopt;   ///< only after this impact, which has to come
  std::optional<ImpactOf> before = std::nullopt;  ///< only before this impact, if that comes
};

/// What is asked of one body at one moment; or which impacts come, and in which order.
struct Constraint {
  std::string body;             ///< by name; of a sequence: empty
  When at;                      ///< the moment
  std::vector<Target> targets;  ///< what its numbers shall be then
  /// Not empty: targets are seen from this body, in its shape's axes (docs/scenes.md).
  std::string relative_to = {};
  std::vector<Region> regions = {};  ///< whenever `at` is
  /// The body hits another one. Such a constraint holds nothing else, and its `at` does not count.
  std::optional<Hit> hits = std::nullopt;
  /// Not empty: impacts in the order in which they come, "cue red", names or patterns with * and ?; "..." stands for any
  /// number of others. Features that meet may follow, "die table (face -z on *)", as Motion::describeEvent has them.
  /// They are those of the bodies that are named first, with bodies that are named or move, from the first one on; what
  /// comes after the last one is free. Such a constraint holds nothing else.
  std::vector<std::string> sequence = {};
  std::string notes = {};            ///< for people; kept in documents
};

}  // namespace carom
