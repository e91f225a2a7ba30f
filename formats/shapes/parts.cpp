// SPDX-License-Identifier: MIT
#include "formats/shapes/parts.hpp"

#include <algorithm>

#include "formats/json/json_writer.hpp"
#include "formats/shapes/rows.hpp"

namespace carom::shapes {

using namespace formats_detail;

Extent surfaceExtent(const Surface& surface, double scale, const ShapePose& at) {
  Extent extent;
  for (const Vec3& p : surface.vertices) extent.extend(at.x + at.q * (scale * p));
  return extent;
}

double surfaceRadius(const Surface& surface, double scale, const Vec3& point) {
  double most = 0;
  for (const Vec3& p : surface.vertices) most = std::max(most, (scale * p - point).norm());
  return most;
}

double numberOf(const Json& value, const char* member) { return value[member].get<double>(); }

void writeRound(JsonWriter& out, double radius, double height) {
  out.beginObject().key("radius").number(radius).key("height").number(height).endObject();
}

double scaleOf(const Json& value) { return value.contains("scale") ? numberOf(value, "scale") : 1; }

void writeScale(JsonWriter& out, double scale) {
  if (scale != 1) out.key("scale").number(scale);
}

}  // namespace carom::shapes
