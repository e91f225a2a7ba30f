// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "adjoint/scene/surface.h"

namespace carom {

/// Convex hull of points: a closed surface of convex polygons, counter-clockwise seen from outside. Points in one
/// plane, but for the rounding of their coordinates, make one face. Its vertices are those of the points that span it,
/// in the order written (of points that are equal, or no further apart than 1e-13 size, the first); points inside it,
/// on a face or on an edge are left out. With `size` the diagonal of the points' bounding box, every vertex is at most
/// 1e-12 size above the plane of every face (over 4000 vertices: of every neighbouring face), and a face's corners are
/// in its plane as nearly. No edge is reflex but for rounding: bend >= -1e-14 size / length (far from the origin, the
/// rounding of the coordinates in place of 1e-14).
///
/// Throws InputError: fewer than four points, numbers not finite or above 1e9 (naming the point), all points at one
/// place, within kLeastLength, on one line or in one plane within 1e-9 size. Safe to call from several threads.
std::shared_ptr<const Surface> convexHull(const std::vector<Vec3>& points);

}  // namespace carom
