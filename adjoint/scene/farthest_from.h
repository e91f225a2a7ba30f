// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/scene/shape.h"

namespace carom {

/// How far a point q lies from the farthest point of a shape, and where that is, in the axes of the shape. With s the
/// reach of the corner, ball or rim that is the farthest, the distance is the most that s(n) - n.q comes to over all unit
/// vectors n. The farthest point lies along the best n, so that
///   d distance = -n.dq + ds/dsize dsize.
struct FarthestFrom {
  FarthestPoint farthest;           ///< at which the point lies; its margin is a difference of distances, m
  double distance = 0;              ///< m
  Vec3 direction = Vec3::UnitZ();   ///< n, unit, from q to the farthest point; any where they coincide
};

/// The farthest point of a shape from q. Throws InputError for a plane, which has none.
FarthestFrom farthestFrom(const Shape& shape, const Vec3& q);

}  // namespace carom
