// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "adjoint/derivative/tangent.h"
#include "editing/motion_function.h"
#include "editing/problem/rows/region_rows.hpp"

/// How far the shape of a body stays on the right side of a region, where the shape itself is kept.
namespace carom::editing_detail {

/// The least clearance over a span of time, m, with its derivative.
struct ShapeClearance {
  RowReading reading;
  double time = 0;   ///< s, where it is least
  double below = 0;  ///< m: nowhere in the span is it lower by more than this
  Clearance::Keeps keeps = Clearance::Keeps::place;
  /// How that time moves with the controls; null where it keeps its place.
  std::function<Eigen::VectorXd(DerivativeTape&, std::span<const ReadingDirection>)> time_rate;
};

/// Within a region. Of a box with half sizes h, one face with the outer normal n a row, c the centre of the region, and
/// m the margin:
///   h - m - max over the points p of the shape of n.(x + R p - c)
/// and of a sphere  r - m - max |x + R p - c|. Null where the motion ends before the span does.
std::optional<ShapeClearance> clearanceInside(const Motion& motion, int body, const BoundRegion& region, int component);

/// Out of a region: the distance of the shape from it, less the margin. Where they overlap it is below 0: of each convex
/// piece by how far the piece or the region would have to move, in the direction in which that is least, so that they
/// part; of several pieces that which overlaps most. A closed mesh counts as its convex hull. Null where the motion ends
/// before the span does.
std::optional<ShapeClearance> clearanceOutside(const Motion& motion, int body, const BoundRegion& region);

/// Rates of the state of a body along its own motion, per second.
BodyStateRate rateInTime(const Motion& motion, int body, double time);

/// Either of them.
inline std::optional<ShapeClearance> shapeClearance(const Motion& motion, int body, const BoundRegion& region,
                                                    int component) {
  return region.region.side == Region::Side::inside ? clearanceInside(motion, body, region, component)
                                                    : clearanceOutside(motion, body, region);
}

}  // namespace carom::editing_detail
