// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/shape.h"

namespace carom {

/// Distance of a point q from the farthest point of a shape, and that point, in the axes of the shape. With s the
/// support function of the farthest corner, ball or rim, the distance is the maximum of s(n) - n.q over all unit
/// vectors n, so that
///   d distance = -n.dq + ds/dsize dsize.
struct FarthestFrom {
  FarthestPoint farthest;           ///< at which the point lies; its margin is a difference of distances, m
  double distance = 0;              ///< m
  Vec3 direction = Vec3::UnitZ();   ///< n, unit, from q to the farthest point; any where they coincide
};

/// The farthest point of a shape from q. Throws InputError for a plane, which has none.
FarthestFrom farthestFrom(const Shape& shape, const Vec3& q);

}  // namespace carom
