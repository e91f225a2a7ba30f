// SPDX-License-Identifier: MIT
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
};

}  // namespace

ShapeKind kindRow(KindOf<Hull>) { return scaledRow<HullRow>(checkHull); }

}  // namespace carom::shapes
