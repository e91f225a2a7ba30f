// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::ode_bridge_detail {

/// What the hull library makes of points: for each facet the numbers of its corners, in order around it, either way.
struct QhullFacets {
  std::vector<std::vector<int>> polygons;  ///< empty when it failed
  std::string problem;                     ///< what it said then
};

/// `points` are about the origin and of a size near 1; facets within `rounding` of one plane are merged. On points that
/// are hardly off many planes the first attempt may merge more than that; the others go about it differently: without
/// merging, then merging with the points turned.
constexpr int kQhullAttempts = 5;
QhullFacets qhullFacets(const std::vector<Vec3>& points, double rounding, int attempt);

}  // namespace carom::ode_bridge_detail
