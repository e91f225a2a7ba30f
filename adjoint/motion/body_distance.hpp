// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "adjoint/motion/contact_source.h"

namespace carom::adjoint_detail {

/// Where two bodies are nearest to each other.
struct Nearest {
  double gap = std::numeric_limits<double>::infinity();  ///< m; 0 where they touch or overlap
  /// That of the features is the distance, and its derivatives are those of the distance; kind -1 where they touch or
  /// overlap.
  FeaturePair features;
  Vec3 normal = Vec3::UnitZ();  ///< unit, from b to a
  /// They are as near in other places, such as along an edge that is parallel to a face: the derivative of the features is then
  /// one of several one-sided ones.
  bool several = false;

  bool apart() const { return features.kind >= 0; }
};

/// The least distance of two bodies over a stretch of time.
struct NearestInTime {
  double time = 0;  ///< s
  Nearest nearest;
  double rate = 0;   ///< m/s, of the distance at that time; about 0 where it is stationary
  double below = 0;  ///< m: no distance of the stretch lies further below this one
  /// Of a separation, where it is least as that of one pair of features ceases to rule and that of another begins to:
  /// the other one, and its rate, of the other sign.
  std::optional<Nearest> other = std::nullopt;
  double other_rate = 0;  ///< m/s
};

/// What a ContactGeometry may know of bodies that do not touch, and of how deep they overlap. Optional, as BodyGeometry.
/// Immutable.
class BodyDistance {
 public:
  virtual ~BodyDistance() = default;

  /// Of all that the two bodies are made of, to rounding.
  virtual Nearest nearest(int a, int b, const Pose& A, const Pose& B) const = 0;

  /// The least distance over [from, to], on arcs that are available so far. Every step of the search is one in which
  /// bounds on the relative motion exclude less, so that nothing is missed between samples. Nothing where no distance
  /// is less than `under`. Throws NotComputable as a search for impacts does.
  virtual std::optional<NearestInTime> nearestInTime(
      int a, int b, const Arc& arc_a, const Arc& arc_b, double from, double to,
      double under = std::numeric_limits<double>::infinity()) const = 0;

  /// The same numbers where the bodies are apart; where they overlap the gap is below 0. Of two convex pieces it is the
  /// most that any direction separates them by, with the features that decide it; of bodies of several pieces the least
  /// of these. Without features where no direction is the one, as for two spheres about one centre. No closed meshes.
  virtual Nearest separation(int a, int b, const Pose& A, const Pose& B) const = 0;
  /// As nearestInTime, through overlaps.
  virtual std::optional<NearestInTime> leastSeparation(
      int a, int b, const Arc& arc_a, const Arc& arc_b, double from, double to,
      double under = std::numeric_limits<double>::infinity()) const = 0;

  /// The geometry of two bodies by themselves, a BodyDistance too: body 0 and body 1. Closed meshes become their convex
  /// hulls, so that what is said to be apart is.
  virtual std::shared_ptr<const ContactGeometry> ofTwo(const Body& first, const Body& second) const = 0;
};

}  // namespace carom::adjoint_detail
