// SPDX-License-Identifier: MIT
#include "formats/drawing/shape_extent.hpp"

#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {

Extent shapeExtent(const Shape& shape, const Vec3& x, const Quat& q) {
  return shapes::formatOf(shape).extent(shape, {x, q});
}

double radiusAbout(const Shape& shape, const Vec3& point) { return shapes::formatOf(shape).radius_about(shape, point); }

}  // namespace carom::formats_detail
