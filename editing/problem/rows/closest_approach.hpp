// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "adjoint/derivative/tangent.h"
#include "adjoint/motion/body_distance.hpp"
#include "adjoint/second_order/reading_direction.h"
#include "editing/problem/rows/quantity_place.hpp"
#include "editing/problem/rows/region_rows.hpp"

/// How far the shapes of two bodies are from each other: at an instant, and where they come nearest over a span.
namespace carom::editing_detail {

using namespace adjoint_detail;

/// The distance of two shapes at one instant of a motion, m; 0 where they touch or overlap. Its derivative is that of
/// the gap of the features that are nearest (the way along which these move on the shapes does not count, as the
/// distance is the least of all), so that
///   d distance = n . (velocity of the place on a - velocity of the place on b) + its rates with respect to the dimensions.
struct DistanceReading {
  int a = -1, b = -1;  ///< bodies
  Instant at;
  double time = 0;  ///< s
  Nearest nearest;
  std::shared_ptr<const ContactGeometry> geometry;  ///< of the motion, which may be gone
  Pose pose_a, pose_b;

  double value() const { return nearest.gap; }
  /// One of each body, in the order a, b; without weights where they touch or overlap.
  std::vector<StateSeed> seeds() const;
  /// How the weights of `seeds` change with the states and the dimensions.
  std::vector<StateSeed> seedRates(const BodyStateRate& da, const BodyStateRate& db) const;
};

/// Throws InputError where the motion's source of contacts does not know distances.
const BodyDistance& distancesOf(const Motion& motion);

DistanceReading readDistance(const Motion& motion, int a, int b, const Instant& at);

/// Where two bodies come nearest over a span.
struct ClosestApproach : DistanceReading {
  /// Stationary in time (Keeps::least), or at an end of the span or an event.
  Clearance::Keeps keeps = Clearance::Keeps::place;
  double below = 0;  ///< m: proven that they are nowhere nearer by more than this
  /// How the time moves with the controls where it is stationary, t_j = -g_tj / g_tt; empty where it keeps its place.
  Eigen::VectorXd timeRate(DerivativeTape& tape, std::span<const ReadingDirection> controls) const;
};

/// Radius of the smaller of two bodies, m; 1 where neither ends.
double lengthOfSmaller(const Scene& scene, int a, int b);
/// The events at which one of two bodies goes over to its next arc, after `from` and before `to`, in order of time.
std::vector<int> eventsWithin(const Motion& motion, int a, int b, double from, double to);
/// The arc of a body from a time on.
const Arc& arcFrom(const Motion& motion, int body, double time);

/// The least distance of two bodies over [from, to]; where they collide within it, 0 at their first impact there. Null
/// where the motion ends before the span does.
std::optional<ClosestApproach> closestApproach(const Motion& motion, int a, int b, double from, double to);

/// The rows of the quantities `distance` and `closest_approach`.
RowReading readDistanceRow(const QuantityPlace& place);
RowReading readClosestApproachRow(const QuantityPlace& place);

}  // namespace carom::editing_detail
