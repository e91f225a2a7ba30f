// SPDX-License-Identifier: MIT
#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

TriangleMesh sphereMesh(const Shape& s, double) {
  std::vector<Ring> rings;
  addHalfBall(rings, std::get<Sphere>(s).radius, 0, true);
  rings.pop_back();  // the equator belongs to both halves
  addHalfBall(rings, std::get<Sphere>(s).radius, 0, false);
  return revolved(rings);
}

}  // namespace

FormatKind formatRow(KindOf<Sphere>) {
  return {
      .read = [](const Json& value, const std::string&, SurfaceFiles&) -> Shape {
        return Sphere{numberOf(value, "radius")};
      },
      .write = [](JsonWriter& out,
                  const Shape& s) { out.beginObject().members("radius", std::get<Sphere>(s).radius).endObject(); },
      .on_one_line = onOneLine,
      .surfaces = noSurfaces,
      .extent = [](const Shape& s,
                   const ShapePose& at) { return extentAround(at.x, Vec3::Constant(std::get<Sphere>(s).radius)); },
      .radius_about = [](const Shape& s, const Vec3& point) { return point.norm() + std::get<Sphere>(s).radius; },
      .contours = [](Contours& out, const Shape& s, const ShapePose& at,
                     const Vec3& viewer) { addStadium(out, std::get<Sphere>(s).radius, 0, at.x, viewer, viewer); },
      .mesh = sphereMesh,
      .collider = [](const ColliderAdder& out, const Shape& s) { out.set(std::get<Sphere>(s)); },
      .from_tapered = notTapered,
  };
}

}  // namespace carom::shapes
