// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_lanes.hpp"
#include "adjoint/motion/body_geometry.h"

namespace carom::adjoint_detail {

/// Lanes in which the dimensions of a body vary: `first` that of the first one, which may lie outside.
struct SizeLanes {
  int first, count;
};

/// With its rates, weight . (R^T (p - x) - border) + normal_weight . R^T n, see FeatureLimit: of a body at (x, R), of a contact at p with
/// the normal n from b to a.
ConstrainedLanes::Number borderRateOf(const FeatureLimit& limit, const V3<ConstrainedLanes::Number>& x, const M3<ConstrainedLanes::Number>& R,
                                      SizeLanes sizes, const V3<ConstrainedLanes::Number>& p, const V3<ConstrainedLanes::Number>& n);

}  // namespace carom::adjoint_detail
