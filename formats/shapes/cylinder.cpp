// SPDX-License-Identifier: MIT
#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

void cylinderContours(Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
  const Cylinder& cylinder = std::get<Cylinder>(s);
  const Vec3& x = at.x;
  // Its upper end is the one towards the viewer.
  const double side = (at.q * Vec3::UnitZ()).dot(viewer) < 0 ? -1 : 1;
  const Vec3 axis = side * (at.q * Vec3::UnitZ()), top = 0.5 * cylinder.height * axis;
  const Vec3 e1 = cylinder.radius * acrossSight(axis, viewer), e2 = axis.cross(e1);
  if (axis.dot(viewer) < 1e-3) {  // the ends are lines
    out.loops.push_back({x + top + e1, x + top - e1, x - top - e1, x - top + e1});
    return;
  }
  // The far half of the upper rim and the near half of the lower one; e2 points away from the viewer.
  out.loops.push_back(stadium(x, top, e1, e2));
  addNearHalf(out, x + top, e1, e2);
}

TriangleMesh cylinderMesh(const Shape& s, double) {
  const Cylinder& cylinder = std::get<Cylinder>(s);
  const double r = cylinder.radius, h = 0.5 * cylinder.height;
  return revolved({{0, h, {0, 1}},
                   {r, h, {0, 1}},
                   {r, h, {1, 0}},
                   {r, 0, {1, 0}},
                   {r, -h, {1, 0}},
                   {r, -h, {0, -1}},
                   {0, -h, {0, -1}}});
}

}  // namespace

FormatKind formatRow(KindOf<Cylinder>) {
  return {
      .read = readRound<Cylinder>,
      .write = writeRound<Cylinder>,
      .on_one_line = onOneLine,
      .surfaces = noSurfaces,
      .extent =
          [](const Shape& s, const ShapePose& at) {
            const Vec3 axis = at.q * Vec3::UnitZ();
            const Cylinder& cylinder = std::get<Cylinder>(s);
            return extentAround(at.x, 0.5 * cylinder.height * axis.cwiseAbs() + reachOfDisc(cylinder.radius, axis));
          },
      .radius_about =
          [](const Shape& s, const Vec3& point) {
            const Cylinder& cylinder = std::get<Cylinder>(s);
            return std::hypot(std::hypot(point.x(), point.y()) + cylinder.radius,
                              std::abs(point.z()) + 0.5 * cylinder.height);
          },
      .contours = cylinderContours,
      .mesh = cylinderMesh,
      .collider =
          [](const ColliderAdder& out, const Shape& s) {
            const Cylinder& cylinder = std::get<Cylinder>(s);
            out.set(gltf::Tapered{false, cylinder.height, cylinder.radius, cylinder.radius});
          },
      .from_tapered = [](const gltf::Tapered& t) -> std::optional<Shape> {
        if (t.capsule || t.bottom != t.top) return std::nullopt;
        return Cylinder{t.bottom, t.height};
      },
  };
}

}  // namespace carom::shapes
