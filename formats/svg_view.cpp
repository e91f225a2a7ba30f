#include "formats/detail/svg_view.hpp"

#include <algorithm>

#include "formats/motion_extent.h"

namespace carom {
namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

Vec3 cornerOf(const Box& box, int index) {
  return 0.5 * box.size.cwiseProduct(Vec3(index & 1 ? 1 : -1, index & 2 ? 1 : -1, index & 4 ? 1 : -1));
}

std::string pointText(const Vec2& p) { return svgNumber(p.x()) + "," + svgNumber(p.y()); }

}  // namespace

std::vector<Vec2> outlineOf(const Box& box, const Vec3& x, const Quat& q, const View& view) {
  std::vector<Vec2> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(view.pixel(x + q * cornerOf(box, i)));
  return convexHull(std::move(corners));
}

std::vector<std::vector<Vec2>> visibleFaces(const Box& box, const Vec3& x, const Quat& q, const View& view) {
  constexpr double kEdgeOn = 1e-3;  // a face seen this nearly from its edge would only be a doubled line
  std::vector<std::vector<Vec2>> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      if (!((q * (side * Vec3::Unit(axis))).dot(view.towardsViewer()) > kEdgeOn)) continue;
      std::vector<Vec2> face;
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        Vec3 corner;
        corner[axis] = side, corner[(axis + 1) % 3] = a, corner[(axis + 2) % 3] = b;
        face.push_back(view.pixel(x + q * (0.5 * box.size.cwiseProduct(corner))));
      }
      faces.push_back(std::move(face));
    }
  return faces;
}

std::vector<Vec2> convexHull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vec2> hull;
  const auto sweep = [&hull](const auto& range, std::size_t floor) {
    for (const Vec2& p : range) {
      while (hull.size() > floor + 1 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the last point starts the other side
  };
  sweep(points, 0);
  const std::vector<Vec2> back(points.rbegin(), points.rend());
  sweep(back, hull.size());
  return hull;
}

std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const Vec2& normal, double offset) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = normal.dot(a) - offset, db = normal.dot(b) - offset;
    if (da <= 0) out.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) out.push_back(a + (da / (da - db)) * (b - a));
  }
  return out;
}

std::string pathData(const Motion& motion, int body, const View& view) {
  const auto& arcs = motion.world_lines[body].arcs;
  std::string out;
  for (int k = 0; k < static_cast<int>(arcs.size()); ++k) {
    const double from = arcs[k].start(), to = arcEnd(motion, body, k);
    const Vec3 x = arcs[k].positionAt(from);
    if (k == 0) out += "M" + pointText(view.pixel(x));
    // The control point of a parabola as a quadratic Bezier curve lies where its end tangents meet, at half time.
    const Vec3 control = x + (0.5 * (to - from)) * arcs[k].velocityAt(from);
    out += " Q" + pointText(view.pixel(control)) + " " + pointText(view.pixel(arcs[k].positionAt(to)));
  }
  return out;
}

}  // namespace carom
