// SPDX-License-Identifier: MIT
#include "formats/svg/contours.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "formats/shapes/rows.hpp"

namespace carom::formats_detail {
namespace {

constexpr int kHalfTurn = 24;            // points of half a circle
constexpr double kSharpCosine = 0.8;     // edges that bend by more than 37 degrees are drawn

// Joins segments, of which as many arrive at a vertex as leave it, to closed loops.
std::vector<std::vector<int>> chained(const std::vector<ContourSegment>& segments) {
  std::multimap<int, int> leaving(segments.begin(), segments.end());
  std::vector<std::vector<int>> loops;
  while (!leaving.empty()) {
    const int start = leaving.begin()->first;
    std::vector<int> loop;
    for (int at = start; loop.empty() || at != start;) {
      const auto next = leaving.find(at);
      if (next == leaving.end()) break;
      loop.push_back(at);
      at = next->second;
      leaving.erase(next);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

void addLoops(Contours& out, const std::vector<Vec3>& vertices, const std::vector<ContourSegment>& segments) {
  for (const std::vector<int>& loop : chained(segments)) {
    std::vector<Vec3> points;
    for (const int v : loop) points.push_back(vertices[static_cast<std::size_t>(v)]);
    out.loops.push_back(std::move(points));
  }
}

// Where the surface is open its other side is seen as well: then the boundary of the faces turned away is taken off,
// which runs round them the other way.
void addSurface(Contours& out, const Surface& surface, double scale, const Vec3& x, const Quat& q, const Vec3& viewer) {
  std::vector<Vec3> vertices;
  for (const Vec3& p : surface.vertices) vertices.push_back(x + q * (scale * p));
  const Vec3 d = q.conjugate() * viewer;
  const auto normal = [&](int face) -> const Vec3& { return surface.faces[static_cast<std::size_t>(face)].normal; };
  const auto seen = [&](int face) { return normal(face).dot(d) > kTowardsViewer; };
  std::vector<ContourSegment> segments;
  for (const Surface::Edge& edge : surface.edges) {
    const bool left = edge.left >= 0 && seen(edge.left), right = edge.right >= 0 && seen(edge.right);
    if (left && right) {
      if (normal(edge.left).dot(normal(edge.right)) < kSharpCosine)
        out.edges.emplace_back(vertices[static_cast<std::size_t>(edge.from)],
                               vertices[static_cast<std::size_t>(edge.to)]);
      continue;
    }
    const bool border = edge.right < 0;
    if (!border && left == right) continue;
    const ContourSegment segment = left ? ContourSegment(edge.from, edge.to) : ContourSegment(edge.to, edge.from);
    segments.push_back(segment);
    if (!surface.closed && !border) segments.push_back(segment);
  }
  addLoops(out, vertices, segments);
}

std::vector<Vec3> stadium(const Vec3& x, const Vec3& top, const Vec3& e1, const Vec3& e2) {
  std::vector<Vec3> loop;
  for (const double end : {1.0, -1.0})
    for (int i = 0; i <= kHalfTurn; ++i) {
      const double turn = std::numbers::pi * i / kHalfTurn;
      loop.push_back(x + end * (top + std::cos(turn) * e1 + std::sin(turn) * e2));
    }
  return loop;
}

Vec3 acrossSight(const Vec3& axis, const Vec3& viewer) {
  const Vec3 c = axis.cross(viewer);
  return c.norm() > 1e-9 ? c.normalized() : viewer.unitOrthogonal();
}

void addStadium(Contours& out, double radius, double height, const Vec3& x, const Vec3& axis, const Vec3& viewer) {
  const Vec3 e1 = acrossSight(axis, viewer);
  out.loops.push_back(stadium(x, 0.5 * height * axis, radius * e1, radius * viewer.cross(e1)));
}

void addNearHalf(Contours& out, const Vec3& middle, const Vec3& e1, const Vec3& e2) {
  const auto rim = [&](int k) {
    const double turn = std::numbers::pi * (k + kHalfTurn) / kHalfTurn;
    return Vec3(middle + std::cos(turn) * e1 + std::sin(turn) * e2);
  };
  for (int i = 0; i < kHalfTurn; ++i) out.edges.emplace_back(rim(i), rim(i + 1));
}

void addContours(Contours& contours, const Shape& shape, const Vec3& x, const Quat& q, const Vec3& viewer) {
  shapes::formatOf(shape).contours(contours, shape, {x, q}, viewer);
}

}  // namespace carom::formats_detail
