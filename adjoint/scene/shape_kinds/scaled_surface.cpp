// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape_kinds/scaled_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

FarthestPoint farthestVertex(const Surface* surface, double scale, const Vec3& n) {
  if (!surface || surface->vertices.empty())
    throw InputError("found a shape without surface, which has no farthest point, expected one with vertices");
  const Vec3* farthest = nullptr;
  double most = -std::numeric_limits<double>::infinity(), second = most;
  for (const Vec3& v : surface->vertices) {
    const double reach = n.dot(v);
    if (reach > most) {
      second = most, most = reach, farthest = &v;
    } else {
      second = std::max(second, reach);
    }
  }
  if (!farthest) farthest = &surface->vertices.front();  // of a direction that is not a number
  FarthestPoint p = FarthestPoint::at(scale * *farthest, 1);
  p.corner_rates.col(0) = *farthest;
  p.margin = scale * (most - second);
  return p;
}

double scaledRadius(const Surface* surface, double scale) {
  double largest = 0;
  if (surface)
    for (const Vec3& v : surface->vertices) largest = std::max(largest, v.squaredNorm());
  return scale * std::sqrt(largest);
}

}  // namespace carom::shapes
