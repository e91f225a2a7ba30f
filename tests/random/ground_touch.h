// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/scene/shape.h"

namespace carom::test {

/// All p with n.p <= c and, where there is a wall, m.p <= d: a half space, or a step whose edge lies along n x m.
struct Ground {
  struct Wall {
    Vec3 m;  ///< unit, across n
    double d = 0;
  };
  Vec3 n;  ///< unit
  double c = 0;
  std::optional<Wall> wall;
};

/// A point at which a body touches a ground: the normal, away from the ground, and the point, from the shape's origin.
struct GroundTouch {
  Vec3 n, r;
};

/// A shape whose axes are the columns of R and whose origin is at x.
struct PlacedShape {
  const Shape& shape;  ///< convex
  Mat3 R;
  Vec3 x;
};

/// How deep it lies in the ground, m; negative: how far it is seen apart. The largest over all normals of the ground of the
/// height of its lowest point; shares nothing with the product.
double depthIn(const Ground& ground, const PlacedShape& placed);

/// Where it is within `reach` of the ground: the ends of what is in touch, of a flat round face many.
std::vector<GroundTouch> touchesOf(const Ground& ground, const PlacedShape& placed, double reach);

}  // namespace carom::test
