// SPDX-License-Identifier: MIT
#include "adjoint/simulate/support_polygon.hpp"

#include <algorithm>

#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

// A pair of contacts is a side where all others are on one hand of it; of those on a line the ends are.
SupportPolygon::SupportPolygon(const std::vector<const Contact*>& contacts, const Vec3& normal) {
  for (const Contact* c : contacts) points_.push_back(c->at.point);
  const int n = static_cast<int>(points_.size());
  double size = 0;
  for (const Vec3& p : points_) size = std::max(size, (p - points_[0]).norm());
  const double room = 1e-9 * size;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 along = pointOf(j) - pointOf(i), across = normal.cross(along);
      if (!(across.norm() > room)) continue;
      const Vec3 inward = across.normalized();
      bool is_side = true, has_room = false;
      for (const Vec3& p : points_) {
        const double inside = inward.dot(p - pointOf(i)), share = along.dot(p - pointOf(i));
        is_side = is_side && inside >= -room;
        if (std::abs(inside) <= room && (share < -room * size || share > along.squaredNorm() + room * size))
          is_side = false;
        has_room = has_room || inside > room;
      }
      if (is_side && has_room) sides_.push_back({i, j, inward});
    }
}

double SupportPolygon::roomAround(const Vec3& point) const {
  double least = sides_.empty() ? -1 : kInfinity;
  for (const Side& side : sides_) least = std::min(least, side.inward.dot(point - pointOf(side.from)));
  return least;
}

}  // namespace carom::adjoint_detail
