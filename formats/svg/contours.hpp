// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "adjoint/scene/shape.h"

namespace carom {

/// The lines that draw a shape, in world coordinates, for a viewer far away.
struct Contours {
  /// Closed curves where the surface turns away from the viewer, counter-clockwise to the viewer around what is seen.
  /// Projected and filled by the non-zero rule they cover the shape exactly, holes left out.
  std::vector<std::vector<Vec3>> loops;
  /// Edges in between; of a part that is not convex some may be hidden.
  std::vector<std::pair<Vec3, Vec3>> edges;
  bool convex = true;  ///< one convex part: every loop is its outline and every edge is seen
};

/// Adds a shape at a pose, seen from the direction of the unit vector `viewer`; not a plane.
void addContours(Contours& contours, const Shape& shape, const Vec3& x, const Quat& q, const Vec3& viewer);

}  // namespace carom
