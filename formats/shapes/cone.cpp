// SPDX-License-Identifier: MIT
#include <numbers>

#include "formats/shapes/parts.hpp"

namespace carom::shapes {

using namespace formats_detail;

namespace {

constexpr int kConePoints = 48;  // of the outline of its base

// The apex and the part of the base's rim that is not behind the side: between the points where lines from the apex as
// the viewer sees it touch the rim. Where the apex is seen within the base there are none, and the rim is the outline.
void coneContours(Contours& out, const Shape& s, const ShapePose& at, const Vec3& viewer) {
  const auto [r, h] = std::get<Cone>(s);
  const Vec3 axis = at.q * Vec3::UnitZ(), base = at.x - 0.5 * h * axis, apex = at.x + 0.5 * h * axis;
  const Vec3 e1 = r * acrossSight(axis, viewer), e2 = axis.cross(e1);  // e2 points away from the viewer's side
  const double towards = axis.dot(viewer), sideways = axis.cross(viewer).norm();
  const auto rim = [&](double turn) { return Vec3(base + std::cos(turn) * e1 + std::sin(turn) * e2); };
  const auto arc = [&](double from, double until) {
    std::vector<Vec3> points;
    for (int i = 0; i <= kConePoints; ++i) points.push_back(rim(from + (until - from) * i / kConePoints));
    return points;
  };
  const double sine = r * towards / (h * sideways);  // of the angle that the tangent points lie beyond e1
  if (!(std::abs(sine) < 1)) {
    std::vector<Vec3> circle = arc(0, 2 * std::numbers::pi);
    circle.pop_back();
    if (towards < 0) std::reverse(circle.begin(), circle.end());
    out.loops.push_back(std::move(circle));
    return;
  }
  // On the picture the rim is an ellipse (r cos, r towards sin), the apex h sideways above its middle.
  const double beyond = std::asin(sine), pi = std::numbers::pi;
  std::vector<Vec3> outline = arc(pi - beyond, towards < 0 ? beyond : 2 * pi + beyond);
  outline.push_back(apex);
  out.loops.push_back(std::move(outline));
  if (!(towards < -1e-3)) return;
  const std::vector<Vec3> near = arc(pi - beyond, 2 * pi + beyond);  // the base is seen, and its edge before the side
  for (std::size_t i = 0; i + 1 < near.size(); ++i) out.edges.emplace_back(near[i], near[i + 1]);
}

TriangleMesh coneMesh(const Shape& s, double) {
  const auto [r, h] = std::get<Cone>(s);
  const Vec2 side = Vec2(h, r).normalized();
  return revolved({{0, 0.5 * h, side}, {0.5 * r, 0, side}, {r, -0.5 * h, side}, {r, -0.5 * h, {0, -1}}, {0, -0.5 * h, {0, -1}}});
}

}  // namespace

FormatKind formatRow(KindOf<Cone>) {
  return {
      .read = readRound<Cone>,
      .write = writeRound<Cone>,
      .on_one_line = onOneLine,
      .surfaces = noSurfaces,
      .extent =
          [](const Shape& s, const ShapePose& at) {
            const auto [r, h] = std::get<Cone>(s);
            const Vec3 axis = at.q * Vec3::UnitZ(), base = at.x - 0.5 * h * axis;
            return extentAround(base, reachOfDisc(r, axis)).extend(at.x + 0.5 * h * axis);
          },
      .radius_about =
          [](const Shape& s, const Vec3& point) {
            const auto [r, h] = std::get<Cone>(s);
            const double across = std::hypot(point.x(), point.y());
            return std::max(std::hypot(across + r, point.z() + 0.5 * h), std::hypot(across, point.z() - 0.5 * h));
          },
      .contours = coneContours,
      .mesh = coneMesh,
      .collider =
          [](const ColliderAdder& out, const Shape& s) {
            out.set(gltf::Tapered{false, std::get<Cone>(s).height, std::get<Cone>(s).radius, 0});
          },
      .from_tapered = [](const gltf::Tapered& t) -> std::optional<Shape> {
        if (t.capsule || t.top != 0) return std::nullopt;
        return Cone{t.bottom, t.height};
      },
  };
}

}  // namespace carom::shapes
