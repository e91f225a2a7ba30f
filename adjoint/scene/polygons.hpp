// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

/// Corners of each, counter-clockwise.
using Polygons = std::vector<std::vector<int>>;

/// Throws InputError, naming the `item`, for a coordinate that no scene can have.
void checkCoordinates(const std::vector<Vec3>& points, const char* item);

/// For each point the number of the first one at the same place: equal coordinates, -0 being 0.
std::vector<int> firstOfEqual(const std::vector<Vec3>& points);

/// The points that are corners, in their order; numbers the corners by them.
std::vector<Vec3> keepUsed(Polygons& polygons, const std::vector<Vec3>& points);

/// One side of an edge, which its polygon `face` runs along from the lower vertex to the higher one or back.
struct HalfEdge {
  int low, high, face;
  bool forward;

  bool beside(const HalfEdge& o) const { return low == o.low && high == o.high; }
};
/// Those of an edge stand together, in the order of the polygons.
std::vector<HalfEdge> halfEdges(const Polygons& polygons);

}  // namespace carom::adjoint_detail
