// SPDX-License-Identifier: MIT
#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

TriangleMesh capsuleMesh(const Shape& s, double) {
  const Capsule& capsule = std::get<Capsule>(s);
  std::vector<Ring> rings;
  addHalfBall(rings, capsule.radius, 0.5 * capsule.height, true);
  // In the middle of the side, so that the accent can change there.
  rings.push_back({capsule.radius, 0, {1, 0}});
  addHalfBall(rings, capsule.radius, -0.5 * capsule.height, false);
  return revolved(rings);
}

}  // namespace

FormatKind formatRow(KindOf<Capsule>) {
  return {
      .read = readRound<Capsule>,
      .write = writeRound<Capsule>,
      .on_one_line = onOneLine,
      .surfaces = noSurfaces,
      .extent =
          [](const Shape& s, const ShapePose& at) {
            const Vec3 axis = at.q * Vec3::UnitZ();
            const Capsule& capsule = std::get<Capsule>(s);
            return extentAround(at.x, 0.5 * capsule.height * axis.cwiseAbs() + Vec3::Constant(capsule.radius));
          },
      .radius_about =
          [](const Shape& s, const Vec3& point) {
            const Vec3 end(point.x(), point.y(), std::abs(point.z()) + 0.5 * std::get<Capsule>(s).height);
            return end.norm() + std::get<Capsule>(s).radius;
          },
      .contours =
          [](Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
            addStadium(out, std::get<Capsule>(s).radius, std::get<Capsule>(s).height, at.x, at.q * Vec3::UnitZ(), viewer);
          },
      .mesh = capsuleMesh,
      .collider =
          [](const ColliderAdder& out, const Shape& s) {
            const Capsule& capsule = std::get<Capsule>(s);
            out.set(gltf::Tapered{true, capsule.height, capsule.radius, capsule.radius});
          },
      .from_tapered = [](const gltf::Tapered& t) -> std::optional<Shape> {
        if (!t.capsule || t.bottom != t.top) return std::nullopt;
        return Capsule{t.bottom, t.height};
      },
  };
}

}  // namespace carom::shapes
