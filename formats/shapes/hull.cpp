// SPDX-License-Identifier: MIT
#include "adjoint/base/errors.h"
#include "formats/shapes/parts.hpp"
#include "ode_bridge/convex_hull.h"

namespace carom::shapes {

using namespace formats_detail;

namespace {

std::shared_ptr<const Surface> hullOfPoints(const Json& value, const std::string& where) {
  std::vector<Vec3> points;
  for (const Json& point : value) points.push_back(readVector(point));
  try {
    return convexHull(points);
  } catch (const InputError& error) {
    throw InputError(where, error.what());
  }
}

Shape readHull(const Json& value, const std::string& where, SurfaceFiles& files) {
  const auto points = value.find("points"), file = value.find("file");
  if ((points == value.end()) == (file == value.end()))
    fail(where, points == value.end() ? describe(value) : "both \"points\" and \"file\"",
         "one of \"points\" and \"file\"");
  Hull hull;
  hull.scale = scaleOf(value);
  if (file == value.end()) {
    hull.surface = hullOfPoints(*points, where + "/points");
  } else {
    hull.file = file->get<std::string>();
    hull.surface = files.find(hull.file, where + "/file", true);
  }
  return hull;
}

void writeHull(JsonWriter& out, const Shape& shape) {
  const Hull& s = std::get<Hull>(shape);
  out.beginObject();
  if (s.file.empty()) {
    out.key("points").beginArray();
    for (const Vec3& vertex : s.surface->vertices) out.value(vertex);
    out.endArray();
  } else {
    out.members("file", s.file);
  }
  writeScale(out, s.scale);
  out.endObject();
}

}  // namespace

FormatKind formatRow(KindOf<Hull>) {
  return surfaceRow<Hull>(readHull, writeHull, [](const Shape& s) { return !std::get<Hull>(s).file.empty(); });
}

}  // namespace carom::shapes
