// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::mesh_repair {

/// Corners of a polygon that triangulate() takes at most: its work grows with their third power.
inline constexpr std::size_t kMostTriangulated = 1000;

/// Triangles that fill a closed polygon, by its corners' numbers and in their order, so that the sum of their areas is
/// least: of a flat polygon, convex or not, that is the polygon. None has corners on one line. Empty where no such
/// triangles are, as all corners lie on a line, or there are too many.
std::vector<std::array<int, 3>> triangulate(const std::vector<Vec3>& polygon);

}  // namespace carom::mesh_repair
