// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "adjoint/scene/shape.h"

namespace carom::formats_detail {

/// The lines that draw a shape, in world coordinates, for a viewer far away.
struct Contours {
  /// Closed curves where the surface turns away from the viewer, counter-clockwise to the viewer around what is seen.
  /// Projected and filled by the non-zero rule they cover the shape exactly, holes left out.
  std::vector<std::vector<Vec3>> loops;
  /// Edges in between; of a part that is not convex some may be hidden.
  std::vector<std::pair<Vec3, Vec3>> edges;
  bool convex = true;  ///< one convex part: every loop is its outline and every edge is seen
};

// ---- for the rows of shapes ----

inline constexpr double kTowardsViewer = 1e-9;  ///< a face seen nearer to its edge than this counts as turned away

using ContourSegment = std::pair<int, int>;  ///< from one vertex to another

/// Joins segments, of which as many arrive at a vertex as leave it, to loops.
void addLoops(Contours& out, const std::vector<Vec3>& vertices, const std::vector<ContourSegment>& segments);
/// The boundary of the faces towards the viewer.
void addSurface(Contours& out, const Surface& surface, double scale, const Vec3& x, const Quat& q, const Vec3& viewer);
/// Half circles about x +- top; e1 x e2 points to the viewer's side, and e2 points as `top` does or across it.
std::vector<Vec3> stadium(const Vec3& x, const Vec3& top, const Vec3& e1, const Vec3& e2);
/// The outline of a capsule.
void addStadium(Contours& out, double radius, double height, const Vec3& x, const Vec3& axis, const Vec3& viewer);
/// Edges along the half of a circle that runs from -e1 by -e2 to e1.
void addNearHalf(Contours& out, const Vec3& middle, const Vec3& e1, const Vec3& e2);
/// Unit, across both the axis and the line of sight (any such when they are parallel).
Vec3 acrossSight(const Vec3& axis, const Vec3& viewer);

/// Adds a shape at a pose, seen from the direction of the unit vector `viewer`; not a plane.
void addContours(Contours& contours, const Shape& shape, const Vec3& x, const Quat& q, const Vec3& viewer);

}  // namespace carom::formats_detail
