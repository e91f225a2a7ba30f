// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape_kinds/scaled_surface.hpp"

#include <algorithm>
#include <cmath>

namespace carom::shapes {

void requireScale(const validation::ShapeCheck& at, double scale, const Surface& surface) {
  using namespace validation;
  const Place where = at.where / "scale";
  requirePositive(where, scale);
  if (scale == 1) return;  // the surface itself was checked when it was made
  const double extent = scaledRadius(&surface, scale);
  if (!(extent >= kLeastLength))
    fail(where, text(scale) + ", which takes it to " + text(extent) + " m",
         "an extent of at least " + text(kLeastLength) + " m");
  if (!(extent <= 2 * kLargest))
    fail(where, text(scale) + ", which takes it to " + text(extent) + " m", "coordinates of at most 1e9");
}

double scaledRadius(const Surface* surface, double scale) {
  double largest = 0;
  if (surface)
    for (const Vec3& v : surface->vertices) largest = std::max(largest, v.squaredNorm());
  return scale * std::sqrt(largest);
}

}  // namespace carom::shapes
