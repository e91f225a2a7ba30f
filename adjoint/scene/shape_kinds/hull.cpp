// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "adjoint/scene/shape_kinds/scaled_surface.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

void checkHull(const Shape& shape, const validation::ShapeCheck& at) {
  const Hull& s = as<Hull>(shape);
  if (!s.surface) validation::fail(at.where, "no surface", "one made by convexHull");
  if (!s.surface->closed || !(s.surface->volume > 0))
    validation::fail(at.where, "a surface that is not closed", "a convex hull");
  requireScale(at, s.scale, *s.surface);
}

struct HullRow : ScaledRow<Hull> {
  static constexpr const char* name = "hull";

  // The distance of the nearest face; a share less, since faces are flat up to rounding.
  static double inner(const Hull& s) {
    if (!hasVolume(s)) return 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Surface::Face& face : s.surface->faces)
      for (int i = 0; i < face.count; ++i) least = std::min(least, face.normal.dot(s.surface->corner(face, i)));
    return least > 0 ? least * s.scale * (1 - 1e-9) : 0;
  }
};

}  // namespace

ShapeKind kindRow(KindOf<Hull>) { return scaledRow<HullRow>(checkHull); }

}  // namespace carom::shapes
