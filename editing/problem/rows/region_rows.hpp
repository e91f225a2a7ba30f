// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "adjoint/second_order/reading_direction.h"
#include "editing/constraint.h"

/// How far a body stays on the right side of a region.
namespace carom::editing_detail {

/// A Region whose defaults are filled in.
struct BoundRegion {
  Region region;
  double from = 0, to = 0;  ///< s
  double margin = 0;        ///< m, see Region::margin
};

/// Rows of a region: one for each face of a box that is not to be left, else one.
int rowsOf(const Region& region);
/// "avoid", "inside", "inside.+x".
std::string rowName(const Region& region, int component);

/// The least clearance over a span of time, m: with y the place of the centre of mass in the axes of the region, half
/// the sizes h of a box, the radius r of a sphere and the margin m,
///   avoid sphere: |y| - r - m            inside sphere:   r - m - |y|
///   avoid box:    max_k |y_k| - h_k - m  inside box face: h_k - m -+ y_k
/// It is found on the arcs in closed form (the squares and the distances are polynomials of the time), so nothing can
/// be missed between samples. `seed` is its derivative; where the centre of mass passes exactly through the centre of a
/// sphere, one of the directions across its velocity is taken.
struct Clearance {
  /// What the time of the reading keeps to as the motion changes.
  enum class Keeps {
    place,     ///< an end of the span, or the event of the seed
    least,     ///< the value is stationary
    two_faces  ///< two faces of a box are equally far
  };
  double value = 0;
  double time = 0;  ///< where it is least
  StateSeed seed;
  Keeps keeps = Keeps::place;
  Mat3 bend = Mat3::Zero();     ///< second derivative of the value by the centre of mass, 1/m, world axes
  Vec3 between = Vec3::Zero();  ///< two_faces: difference of their normals, world axes
};
/// Null where the motion ends before the span does.
std::optional<Clearance> leastClearance(const Motion& motion, int body, const BoundRegion& region, int component);

/// How the time of a clearance moves with the controls; empty where it keeps its place.
Eigen::VectorXd clearanceTimeRate(const Clearance& clearance, DerivativeTape& tape,
                                  std::span<const ReadingDirection> controls);

}  // namespace carom::editing_detail
