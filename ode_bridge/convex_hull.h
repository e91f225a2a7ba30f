// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "adjoint/scene/surface.h"

namespace carom {

/// Convex hull of points: a closed surface of convex polygons, counter-clockwise seen from outside. Points that are
/// coplanar up to the rounding of their coordinates form one face. Its vertices are the extreme points, in the given
/// order (of points that are equal, or no further apart than 1e-13 size, the first); points inside it, on a face or
/// on an edge are dropped. With `size` the diagonal of the points' bounding box, every vertex is at most 1e-12 size
/// above the plane of every face (over 4000 vertices: of every neighbouring face), and the corners of a face are in
/// its plane to the same accuracy. Edges are convex up to rounding: bend >= -1e-14 size / length (far from the
/// origin, the rounding of the coordinates in place of 1e-14).
///
/// Throws InputError: fewer than four points, numbers not finite or above 1e9 (naming the point), all points
/// coincident within kLeastLength, or collinear or coplanar within 1e-9 size. Safe to call from several threads.
std::shared_ptr<const Surface> convexHull(const std::vector<Vec3>& points);

}  // namespace carom
