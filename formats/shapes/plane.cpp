// SPDX-License-Identifier: MIT
#include <limits>

#include "formats/base/unit.hpp"
#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

Shape readPlane(const Json& value, const std::string& where, SurfaceFiles&) {
  Vec3 normal = readVector(value["normal"]);
  const double length = normal.stableNorm();
  if (!(length > 0)) fail(where + "/normal", describe(value["normal"]), "a vector that is not 0");
  if (std::abs(normal.squaredNorm() - 1) > kUnitRounding) normal = (normal / length).normalized();
  return Plane{normal, value.value("offset", 0.0)};
}

TriangleMesh planeMesh(const Shape&, double half_width) {
  TriangleMesh mesh;
  addFace(mesh, Vec3::Zero(), half_width * Vec3::UnitX(), half_width * Vec3::UnitY());
  return mesh;
}

}  // namespace

FormatKind formatRow(KindOf<Plane>) {
  return {
      .read = readPlane,
      .write =
          [](JsonWriter& out, const Shape& s) {
            const Plane& plane = std::get<Plane>(s);
            out.beginObject().members("normal", plane.normal, "offset", plane.offset).endObject();
          },
      .on_one_line = onOneLine,
      .surfaces = noSurfaces,
      .extent = [](const Shape&, const ShapePose&) { return Extent(); },
      .radius_about = [](const Shape&, const Vec3&) { return std::numeric_limits<double>::infinity(); },
      .contours = [](Contours&, const Shape&, const ShapePose&, const Vec3&) {},
      .mesh = planeMesh,
      .collider = [](const ColliderAdder& out, const Shape& s) { out.setPlane(std::get<Plane>(s)); },
      .from_tapered = notTapered,
  };
}

}  // namespace carom::shapes
