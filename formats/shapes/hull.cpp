// SPDX-License-Identifier: MIT
#include "adjoint/base/errors.h"
#include "formats/documents/scene_reader.hpp"
#include "formats/documents/surface_files.hpp"
#include "formats/drawing/triangle_mesh.hpp"
#include "formats/gltf/physics_nodes.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/shapes/parts.hpp"
#include "formats/shapes/rows.hpp"
#include "formats/svg/contours.hpp"
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
    hull.surface = files.hull(hull.file, where + "/file");
  }
  return hull;
}

void writeHull(JsonWriter& out, const Shape& shape) {
  const Hull& s = std::get<Hull>(shape);
  out.beginObject();
  if (s.file.empty()) {
    out.key("points").beginArray();
    for (const Vec3& vertex : s.surface->vertices) out.vector(vertex);
    out.endArray();
  } else {
    out.key("file").text(s.file);
  }
  writeScale(out, s.scale);
  out.endObject();
}

}  // namespace

FormatKind formatRow(KindOf<Hull>) {
  return {
      .read = readHull,
      .write = writeHull,
      .on_one_line = [](const Shape& s) { return !std::get<Hull>(s).file.empty(); },
      .extent = [](const Shape& s, const ShapePose& at) {
        return surfaceExtent(*std::get<Hull>(s).surface, std::get<Hull>(s).scale, at);
      },
      .radius_about = [](const Shape& s, const Vec3& point) {
        return surfaceRadius(*std::get<Hull>(s).surface, std::get<Hull>(s).scale, point);
      },
      .contours =
          [](Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
            addSurface(out, *std::get<Hull>(s).surface, std::get<Hull>(s).scale, at.x, at.q, viewer);
          },
      .mesh = [](const Shape& s, double) { return surfaceMesh(*std::get<Hull>(s).surface, std::get<Hull>(s).scale); },
      .collider = [](const ColliderAdder& out,
                     const Shape& s) { out.setSurface(*std::get<Hull>(s).surface, std::get<Hull>(s).scale, true); },
      .from_tapered = notTapered,
  };
}

}  // namespace carom::shapes
