// SPDX-License-Identifier: MIT
#include "formats/shapes/rows.hpp"

#include "adjoint/scene/shape_kinds/table.hpp"

namespace carom::shapes {

using namespace formats_detail;

const std::array<FormatKind, std::variant_size_v<Shape>>& formatKinds() {
  static const auto kinds = tableOf([](auto kind) {
    static_assert(requires { formatRow(kind); }, "a shape without a row: see formats/shapes/rows.hpp");
    return formatRow(kind);
  });
  return kinds;
}

const FormatKind& formatOf(const Shape& shape) { return formatKinds()[shape.index()]; }

std::vector<SurfaceUse> surfacesOf(Shape& shape) {
  std::vector<SurfaceUse> all;
  formatOf(shape).surfaces(shape, "", all);
  return all;
}

}  // namespace carom::shapes

namespace carom::formats_detail {

Extent shapeExtent(const Shape& shape, const Vec3& x, const Quat& q) {
  return shapes::formatOf(shape).extent(shape, {x, q});
}

double radiusAbout(const Shape& shape, const Vec3& point) { return shapes::formatOf(shape).radius_about(shape, point); }

}  // namespace carom::formats_detail
