// SPDX-License-Identifier: MIT
#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

// Each edge of a box runs along one axis, between the faces of the two others.
void boxContours(Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
  const Box& box = std::get<Box>(s);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(at.x + at.q * (0.5 * box.size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1))));
  const Vec3 d = at.q.conjugate() * viewer;
  std::vector<ContourSegment> segments;
  for (int axis = 0; axis < 3; ++axis)
    for (const int u : {0, 1})
      for (const int v : {0, 1}) {
        const int first = (axis + 1) % 3, second = (axis + 2) % 3;
        const int low = (u << first) | (v << second), high = low | (1 << axis);
        const bool seen_u = (u ? d[first] : -d[first]) > kTowardsViewer;
        const bool seen_v = (v ? d[second] : -d[second]) > kTowardsViewer;
        const auto corner = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
        if (seen_u && seen_v) out.edges.emplace_back(corner(low), corner(high));
        if (seen_u == seen_v) continue;
        // Seen from outside, face u has its edge at v run upwards when the two signs agree.
        segments.push_back((u == v) == seen_u ? ContourSegment(low, high) : ContourSegment(high, low));
      }
  addLoops(out, corners, segments);
}

TriangleMesh boxMesh(const Shape& s, double) {
  const Box& box = std::get<Box>(s);
  TriangleMesh mesh;
  const Vec3 half = box.size / 2;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const Vec3 n = half[axis] * Vec3::Unit(axis), u = half[next] * Vec3::Unit(next), v = half[last] * Vec3::Unit(last);
    addFace(mesh, n, u, v);
    addFace(mesh, -n, v, u);
  }
  return mesh;
}

}  // namespace

FormatKind formatRow(KindOf<Box>) {
  return {
      .read = [](const Json& value, const std::string&, SurfaceFiles&) -> Shape {
        return Box{readVector(value["size"])};
      },
      .write = [](JsonWriter& out,
                  const Shape& s) { out.beginObject().members("size", std::get<Box>(s).size).endObject(); },
      .on_one_line = onOneLine,
      .surfaces = noSurfaces,
      .extent =
          [](const Shape& s, const ShapePose& at) {
            return extentAround(at.x, 0.5 * (at.q.toRotationMatrix().cwiseAbs() * std::get<Box>(s).size));
          },
      .radius_about = [](const Shape& s,
                         const Vec3& point) { return (0.5 * std::get<Box>(s).size + point.cwiseAbs()).norm(); },
      .contours = boxContours,
      .mesh = boxMesh,
      .collider = [](const ColliderAdder& out, const Shape& s) { out.set(std::get<Box>(s)); },
      .from_tapered = notTapered,
  };
}

}  // namespace carom::shapes
