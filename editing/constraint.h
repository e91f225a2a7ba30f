// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/base/times.h"
#include "adjoint/base/types.h"
#include "adjoint/scene/shape.h"

namespace carom {

/// The type of `any`.
struct Free {};
/// Leaves a component of a target free.
inline constexpr Free any{};

/// A number of a target, SI: a value, or free. A computed NaN is not free: constraints refuse it.
class TargetNumber {
 public:
  /// A value.
  constexpr TargetNumber(double number) : number_(number) {}  // NOLINT: for {0.1, any, 2}
  /// Free.
  constexpr TargetNumber(Free) : number_(std::numeric_limits<double>::quiet_NaN()), free_(true) {}  // NOLINT
  constexpr bool isFree() const { return free_; }       ///< no number
  constexpr operator double() const { return number_; }  ///< NaN if free

 private:
  double number_;
  bool free_ = false;
};

/// When a constraint holds: at a time; just before the body's n-th impact (1 = first), counting only those with
/// `with` if not empty; at some time in an interval, which the edit chooses; or when the body has come to rest.
struct When {
  Seconds time = 0;  ///< s; start of an interval
  int impact = 0;    ///< 0: not at an impact
  std::string with;  ///< body that it meets; empty: any
  std::optional<TimeSpan> span;  ///< s, first and last: at some time in between
  bool rest = false;  ///< when the body has come to rest for the remaining motion

  /// At a time, s.
  template <std::floating_point T>
  When(T t) : time(t) {}  // NOLINT: for nail("hat", 1.4)
  /// At a time of a struct.
  When(Seconds t) : time(t) {}  // NOLINT: likewise
  /// nail("hat", 2) does not compile: the second impact is nthImpact(2), a time is 2.0.
  template <class T>
    requires std::integral<T>
  When(T) = delete;
  /// Just before the n-th impact, with one body or with any. Throws InputError for n < 1.
  When(int n, std::string other) : impact(n), with(std::move(other)) {
    if (n < 1) throw InputError("nthImpact", "found impact " + std::to_string(n) + ", expected 1 (the first) or more");
  }
  /// At a given time.
  bool isTime() const { return impact == 0 && !span && !rest; }
};
/// Just before the n-th impact of the body (1 = first), with the body `with` or with any. Throws InputError for n < 1.
inline When nthImpact(int n, std::string with = "") { return When(n, std::move(with)); }
/// A number of impacts is an int.
template <class T>
  requires(std::floating_point<T> || NoTime<T>)
When nthImpact(T n, std::string with = "") = delete;
/// At some time in [from, to].
inline When between(double from, double to) {
  When when(from);
  when.span = {from, to};
  return when;
}
/// Neither a bool nor a character is a time.
template <class From, class To>
  requires(NoTime<From> || NoTime<To>)
When between(From from, To to) = delete;
/// When the body has come to rest, and stays so to the end of the motion.
inline When atRest() {
  When when(0.0);
  when.rest = true;
  return when;
}

/// One target of a constraint. `quantity` is the word of the scene document: position, orientation, velocity,
/// angular_velocity, point, contact, time, speed, kinetic_energy, impulse, height, distance, closest_approach. `value`
/// has 3 numbers (`any` leaves one free); the quaternion w, x, y, z (shape to world) for orientation; 1 number from
/// time on. For a range, the `value` of the component is `any`, and `min`, `max` (empty, or as many as
/// `value`; `any`: no limit on that side) give the bounds.
struct Target {
  std::string quantity;            ///< word of the scene document
  std::vector<TargetNumber> value;  ///< SI; `any` if free or in a range
  Vec3 body_point = Vec3::Zero();  ///< point: in the shape's axes
  std::vector<TargetNumber> min = {};  ///< lower bounds, SI
  std::vector<TargetNumber> max = {};  ///< upper bounds, SI
  std::string to = {};             ///< distance, closest_approach: name of the other body
  /// closest_approach: s, first and last; without it the whole motion.
  std::optional<TimeSpan> during = std::nullopt;
};

/// A region that the body stays out of, or within, during a time interval: at every moment, not only at samples.
struct Region {
  /// Stays out of it, or within it.
  enum class Side { avoid, inside };
  /// What is tested against the region.
  enum class Keep {
    ball,  ///< a ball about its centre of mass
    shape  ///< its exact shape
  };
  Side side = Side::avoid;                     ///< which of the two
  std::variant<Sphere, Box> shape = Sphere{};  ///< of the region
  Vec3 position = Vec3::Zero();         ///< of the centre of the region, m, world
  Quat orientation = Quat::Identity();  ///< its axes to world, unit
  /// s, first and last; without it the whole motion.
  std::optional<TimeSpan> during = std::nullopt;
  /// m; of a ball its radius (default: the bounding radius of the body); of a shape its distance from the boundary of
  /// the region (default: 0).
  std::optional<double> margin = std::nullopt;
  Keep keep = Keep::ball;  ///< the ball or the shape
};

/// The n-th impact of a body (1 = first), counting only those with `with` if not empty.
struct ImpactOf {
  std::string body;       ///< by name
  int n = 1;              ///< which of them
  std::string with = {};  ///< body that it meets; empty: any
};

/// Requires that a body hits another one: the first admissible impact of the two. If the motion has one only outside
/// of `during`, that one is moved there.
struct Hit {
  std::string with;  ///< the other body, by name
  /// s, first and last time; without it at any time.
  std::optional<TimeSpan> during = std::nullopt;
  std::optional<ImpactOf> after = std::nullopt;   ///< only after this impact, which is required
  std::optional<ImpactOf> before = std::nullopt;  ///< only before this impact, if that happens
};

/// A constraint on one body at one moment; or a required impact sequence.
struct Constraint {
  std::string body;             ///< by name; of a sequence: empty
  When at;                      ///< the moment
  std::vector<Target> targets;  ///< target values
  /// Not empty: targets are relative to this body, in the axes of its shape (docs/scenes.md).
  std::string relative_to = {};
  std::vector<Region> regions = {};  ///< independent of `at`
  /// The body hits another one. Such a constraint has no other targets, and its `at` is ignored.
  std::optional<Hit> hits = std::nullopt;
  /// Not empty: required impacts in order, "cue red", names or patterns with * and ?; "..." stands for any number of
  /// impacts. Features may follow, "die table (face -z on *)", as in Motion::describeEvent. Compared with the
  /// reported impacts of the bodies named first, with bodies that are named or move, from the first one on; what
  /// follows the last entry is free. Such a constraint has no other targets.
  std::vector<std::string> sequence = {};
  std::string notes = {};            ///< for readers; kept in documents
  /// A soft constraint: not met exactly, but a term of what is minimised. With this weight w > 0 it adds
  /// 1/2 sum (w r / s)^2 over its rows, r the error of a row (SI), s its natural scale; `between` two times the least of
  /// these sums in the interval. Not for hits and sequences.
  std::optional<double> soft = std::nullopt;
};

}  // namespace carom
