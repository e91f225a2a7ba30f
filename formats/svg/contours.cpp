// SPDX-License-Identifier: MIT
#include "formats/svg/contours.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <variant>

namespace carom {
namespace {

constexpr int kHalfTurn = 24;            // points of half a circle
constexpr double kSharpCosine = 0.8;     // edges that bend by more than 37 degrees are drawn
constexpr double kTowardsViewer = 1e-9;  // a face seen nearer to its edge than this counts as turned away

using Segment = std::pair<int, int>;  // from one vertex to another

// Joins segments, of which as many arrive at a vertex as leave it, to closed loops.
std::vector<std::vector<int>> chained(const std::vector<Segment>& segments) {
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

void addLoops(Contours& out, const std::vector<Vec3>& vertices, const std::vector<Segment>& segments) {
  for (const std::vector<int>& loop : chained(segments)) {
    std::vector<Vec3> points;
    for (const int v : loop) points.push_back(vertices[static_cast<std::size_t>(v)]);
    out.loops.push_back(std::move(points));
  }
}

// The boundary of the faces towards the viewer. Where the surface is open its other side is seen as well: then the
// boundary of the faces turned away is taken off, which runs round them the other way.
void addSurface(Contours& out, const Surface& surface, double scale, const Vec3& x, const Quat& q, const Vec3& viewer) {
  std::vector<Vec3> vertices;
  for (const Vec3& p : surface.vertices) vertices.push_back(x + q * (scale * p));
  const Vec3 d = q.conjugate() * viewer;
  const auto normal = [&](int face) -> const Vec3& { return surface.faces[static_cast<std::size_t>(face)].normal; };
  const auto seen = [&](int face) { return normal(face).dot(d) > kTowardsViewer; };
  std::vector<Segment> segments;
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
    const Segment segment = left ? Segment(edge.from, edge.to) : Segment(edge.to, edge.from);
    segments.push_back(segment);
    if (!surface.closed && !border) segments.push_back(segment);
  }
  addLoops(out, vertices, segments);
}

// Each edge of a box runs along one axis, between the faces of the two others.
void addBox(Contours& out, const Box& box, const Vec3& x, const Quat& q, const Vec3& viewer) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(x + q * (0.5 * box.size.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1))));
  const Vec3 d = q.conjugate() * viewer;
  std::vector<Segment> segments;
  for (int axis = 0; axis < 3; ++axis)
    for (const int u : {0, 1})
      for (const int v : {0, 1}) {
        const int first = (axis + 1) % 3, second = (axis + 2) % 3;
        const int low = (u << first) | (v << second), high = low | (1 << axis);
        const bool seen_u = (u ? d[first] : -d[first]) > kTowardsViewer;
        const bool seen_v = (v ? d[second] : -d[second]) > kTowardsViewer;
        const auto at = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
        if (seen_u && seen_v) out.edges.emplace_back(at(low), at(high));
        if (seen_u == seen_v) continue;
        // Seen from outside, face u has its edge at v run upwards when the two signs agree.
        segments.push_back((u == v) == seen_u ? Segment(low, high) : Segment(high, low));
      }
  addLoops(out, corners, segments);
}

// Half circles about x +- top; e1 x e2 points to the viewer's side, and e2 points as `top` does or across it.
std::vector<Vec3> stadium(const Vec3& x, const Vec3& top, const Vec3& e1, const Vec3& e2) {
  std::vector<Vec3> loop;
  for (const double end : {1.0, -1.0})
    for (int i = 0; i <= kHalfTurn; ++i) {
      const double turn = std::numbers::pi * i / kHalfTurn;
      loop.push_back(x + end * (top + std::cos(turn) * e1 + std::sin(turn) * e2));
    }
  return loop;
}

// Unit, across both the axis and the line of sight (any such when they are parallel).
Vec3 across(const Vec3& axis, const Vec3& viewer) {
  const Vec3 c = axis.cross(viewer);
  return c.norm() > 1e-9 ? c.normalized() : viewer.unitOrthogonal();
}

void addCapsule(Contours& out, double radius, double height, const Vec3& x, const Vec3& axis, const Vec3& viewer) {
  const Vec3 e1 = across(axis, viewer);
  out.loops.push_back(stadium(x, 0.5 * height * axis, radius * e1, radius * viewer.cross(e1)));
}

void addCylinder(Contours& out, const Cylinder& cylinder, const Vec3& x, const Quat& q, const Vec3& viewer) {
  // Its upper end is the one towards the viewer.
  const double side = (q * Vec3::UnitZ()).dot(viewer) < 0 ? -1 : 1;
  const Vec3 axis = side * (q * Vec3::UnitZ()), top = 0.5 * cylinder.height * axis;
  const Vec3 e1 = cylinder.radius * across(axis, viewer), e2 = axis.cross(e1);
  if (axis.dot(viewer) < 1e-3) {  // the ends are lines
    out.loops.push_back({x + top + e1, x + top - e1, x - top - e1, x - top + e1});
    return;
  }
  // The far half of the upper rim and the near half of the lower one; e2 points away from the viewer.
  out.loops.push_back(stadium(x, top, e1, e2));
  for (int i = 0; i < kHalfTurn; ++i) {
    const auto rim = [&](int k) {
      const double turn = std::numbers::pi * (k + kHalfTurn) / kHalfTurn;
      return Vec3(x + top + std::cos(turn) * e1 + std::sin(turn) * e2);
    };
    out.edges.emplace_back(rim(i), rim(i + 1));
  }
}

struct Tracer {
  Contours& out;
  const Vec3& x;
  const Quat& q;
  const Vec3& viewer;

  void operator()(const Sphere& sphere) const { addCapsule(out, sphere.radius, 0, x, viewer, viewer); }
  void operator()(const Box& box) const { addBox(out, box, x, q, viewer); }
  void operator()(const Plane&) const {}
  void operator()(const Capsule& capsule) const {
    addCapsule(out, capsule.radius, capsule.height, x, q * Vec3::UnitZ(), viewer);
  }
  void operator()(const Cylinder& cylinder) const { addCylinder(out, cylinder, x, q, viewer); }
  void operator()(const Hull& hull) const { addSurface(out, *hull.surface, hull.scale, x, q, viewer); }
  void operator()(const Mesh& mesh) const {
    out.convex = false;
    addSurface(out, *mesh.surface, mesh.scale, x, q, viewer);
  }
  void operator()(const Compound& compound) const {
    out.convex = false;
    for (const CompoundPart& part : compound.parts)
      addContours(out, part.shape, x + q * part.position, q * part.orientation, viewer);
  }
};

}  // namespace

void addContours(Contours& contours, const Shape& shape, const Vec3& x, const Quat& q, const Vec3& viewer) {
  std::visit(Tracer{contours, x, q, viewer}, shape);
}

}  // namespace carom
