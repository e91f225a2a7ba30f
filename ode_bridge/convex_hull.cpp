// SPDX-License-Identifier: MIT
#include "ode_bridge/convex_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "adjoint/base/refuse.hpp"
#include "adjoint/scene/polygons.hpp"
#include "ode_bridge/qhull_facets.hpp"

namespace carom {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

namespace {

constexpr double kFlattest = 1e-9;   // least thickness of the points, of their size
constexpr double kAbove = 1e-12;     // how far a vertex may be above a face, of the size
constexpr double kShortest = 1e-13;  // least length of an edge, of the size: below, its direction is rounding
constexpr double kReflex = 1e-14;    // how far an edge may be sunk in, of the size
constexpr std::size_t kAllPairs = 100'000'000;  // points times faces up to which every point is held against every face

const Vec3& at(const std::vector<Vec3>& points, int i) { return points[static_cast<std::size_t>(i)]; }

void checkNumbers(const std::vector<Vec3>& points) {
  if (points.size() < 4)
    refuse("", "found a hull of ", points.size(), " points, expected four or more that span a volume");
  if (points.size() > std::size_t{100'000'000})
    refuse("", "found a hull of ", points.size(), " points, expected at most 100000000");
  checkCoordinates(points, "point");
}

Eigen::AlignedBox3d boxAround(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

/// Size of the points; throws when they do not span a volume.
double checkSpread(const std::vector<Vec3>& points) {
  const double size = boxAround(points).sizes().stableNorm();
  const auto expected =
      ", expected points that span a volume; for something flat a \"box\" as thick as it is, or a \"mesh\" of a fixed "
      "body";
  if (!(size > 0)) refuse("", "found all ", points.size(), " points of a hull at one place", expected);
  if (!(size >= kLeastLength))
    refuse("", "found points of a hull within ", about(size, 3), " m of each other, expected an extent of at least ",
           about(kLeastLength, 3), " m");
  const auto farthest = [&](auto&& measure) {
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vec3& a, const Vec3& b) { return measure(a) < measure(b); });
  };
  const Vec3 a = points[0];
  const Vec3 b = farthest([&](const Vec3& p) { return (p - a).squaredNorm(); });
  const Vec3 along = (b - a).normalized();
  const auto fromLine = [&](const Vec3& p) { return along.cross(p - a).norm(); };
  const Vec3 c = farthest(fromLine);
  if (!(fromLine(c) > kFlattest * size))
    refuse("", "found all ", points.size(), " points of a hull on one line", expected);
  const Vec3 normal = along.cross(c - a).normalized();
  const auto fromPlane = [&](const Vec3& p) { return std::abs(normal.dot(p - a)); };
  const double thickness = fromPlane(farthest(fromPlane));
  if (!(thickness > kFlattest * size))
    refuse("", "found all ", points.size(), " points of a hull in one plane (within ", about(thickness, 3), " m)",
           expected);
  return size;
}

/// Moved to the origin and divided by a power of two, so that the library's tolerances are relative to the size.
std::vector<Vec3> normalized(const std::vector<Vec3>& points, double size) {
  const Vec3 middle = boxAround(points).center();
  const int exponent = -std::ilogb(size);
  std::vector<Vec3> moved;
  moved.reserve(points.size());
  for (const Vec3& p : points)
    moved.push_back((p - middle).unaryExpr([&](double x) { return std::ldexp(x, exponent); }));
  return moved;
}

/// Rounding of the coordinates as they are written, of the size: what is far out is known less well.
double roundingOf(const std::vector<Vec3>& points, double size) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return std::min(4 * std::numeric_limits<double>::epsilon() * largest / size, kAbove / 5);
}

/// Corners between two faces only are on an edge and do not span the hull. False when a face is lost.
bool dropEdgePoints(Polygons& polygons, std::size_t points) {
  for (bool again = true; again;) {
    again = false;
    std::vector<int> faces(points, 0);
    for (const auto& polygon : polygons)
      for (int v : polygon) ++faces[static_cast<std::size_t>(v)];
    for (auto& polygon : polygons) {
      const auto erased = std::erase_if(polygon, [&](int v) { return faces[static_cast<std::size_t>(v)] < 3; });
      again = again || erased > 0;
      if (polygon.size() < 3) return false;
    }
  }
  return true;
}

/// Counter-clockwise seen from outside, the least corner first, faces in the order of their corners: the same for the
/// same points whatever the library's order.
void orderPolygons(Polygons& polygons, const std::vector<Vec3>& points) {
  std::set<int> used;
  for (const auto& polygon : polygons) used.insert(polygon.begin(), polygon.end());
  Vec3 inside = Vec3::Zero();
  for (int v : used) inside += at(points, v) / static_cast<double>(used.size());
  for (auto& polygon : polygons) {
    const Vec3 a = at(points, polygon[0]);
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
      area += (at(points, polygon[i]) - a).cross(at(points, polygon[i + 1]) - a);
    if (area.dot(a - inside) < 0) std::reverse(polygon.begin(), polygon.end());
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  }
  std::sort(polygons.begin(), polygons.end());
}

/// Every edge between two faces that run along it in opposite directions, and the topology of a ball.
bool closesOnce(const Polygons& polygons) {
  std::set<std::pair<int, int>> sides;
  std::set<int> vertices;
  for (const auto& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      vertices.insert(polygon[i]);
      if (!sides.emplace(polygon[i], polygon[(i + 1) % polygon.size()]).second) return false;
    }
  for (const auto& [from, to] : sides)
    if (!sides.contains({to, from})) return false;
  return vertices.size() + polygons.size() == sides.size() / 2 + 2;
}

/// Largest height of a point over a face's plane, or distance of a face's corner from its own.
double unevenness(const Surface& s, const std::vector<Vec3>& points) {
  double worst = 0;
  const auto height = [&](const Surface::Face& f, const Vec3& p) { return f.normal.dot(p - s.corner(f, 0)); };
  for (const Surface::Face& f : s.faces)
    for (int i = 0; i < f.count; ++i) worst = std::max(worst, std::abs(height(f, s.corner(f, i))));
  if (s.faces.size() <= kAllPairs / points.size()) {
    for (const Surface::Face& f : s.faces)
      for (const Vec3& p : points) worst = std::max(worst, height(f, p));
    return worst;
  }
  for (const Surface::Edge& e : s.edges)
    for (const auto& [face, other] : {std::pair{e.left, e.right}, std::pair{e.right, e.left}}) {
      const Surface::Face &f = s.faces[static_cast<std::size_t>(face)], &g = s.faces[static_cast<std::size_t>(other)];
      for (int i = 0; i < g.count; ++i) worst = std::max(worst, height(f, s.corner(g, i)));
    }
  return worst;
}

double lengthOf(const Surface& s, const Surface::Edge& e) {
  return (at(s.vertices, e.to) - at(s.vertices, e.from)).norm();
}

/// Largest product of length and reflex bend of an edge: how far it is sunk in, where its faces are no wider than it.
double sunk(const Surface& s) {
  double worst = 0;
  for (const Surface::Edge& e : s.edges) worst = std::max(worst, -e.bend * lengthOf(s, e));
  return worst;
}

/// The points without those, of two that an edge shorter than `least` joins, that come later.
std::vector<Vec3> withoutCrowded(const std::vector<Vec3>& points, const Surface& s, double least) {
  std::vector<char> dropped(s.vertices.size(), 0);
  for (const Surface::Edge& e : s.edges) {
    const auto [early, late] = std::minmax(e.from, e.to);
    if (lengthOf(s, e) < least && !dropped[static_cast<std::size_t>(early)])
      dropped[static_cast<std::size_t>(late)] = 1;
  }
  std::vector<Vec3> kept = points;
  for (std::size_t v = 0; v < dropped.size(); ++v)
    if (dropped[v]) std::erase(kept, s.vertices[v]);
  return kept;
}

/// The hull from the library's facets; null, with what is wrong, when they do not make one.
std::shared_ptr<const Surface> surfaceOf(Polygons polygons, const std::vector<Vec3>& points,
                                         const std::vector<int>& first, double size, double rounding,
                                         std::string& problem) {
  for (auto& polygon : polygons)
    for (int& v : polygon) v = first[static_cast<std::size_t>(v)];
  problem = "a face without area";
  if (!dropEdgePoints(polygons, points.size())) return nullptr;
  orderPolygons(polygons, points);
  problem = "faces that do not close";
  if (!closesOnce(polygons)) return nullptr;
  std::vector<Vec3> vertices = keepUsed(polygons, points);
  auto surface = std::make_shared<Surface>(assembleSurface(std::move(vertices), polygons));
  problem = "a face without area";
  for (const Surface::Face& face : surface->faces)
    if (face.normal == Vec3::Zero()) return nullptr;
  problem = "a face with points outside of it";
  if (!(unevenness(*surface, points) <= kAbove * size)) return nullptr;
  problem = "a reflex edge";
  return sunk(*surface) <= std::max(kReflex, rounding) * size ? surface : nullptr;
}

}  // namespace

std::shared_ptr<const Surface> convexHull(const std::vector<Vec3>& points) {
  checkNumbers(points);
  const double size = checkSpread(points);
  const std::vector<Vec3> moved = normalized(points, size);
  const std::vector<int> first = firstOfEqual(points);
  const double rounding = roundingOf(points, size);
  std::string problem;
  for (int attempt = 0; attempt < kQhullAttempts; ++attempt) {
    const QhullFacets facets = qhullFacets(moved, rounding, attempt);
    problem = facets.problem;
    if (facets.polygons.empty()) continue;
    if (auto surface = surfaceOf(facets.polygons, points, first, size, rounding, problem)) {
      const std::vector<Vec3> apart = withoutCrowded(points, *surface, kShortest * size);
      return apart.size() < points.size() ? convexHull(apart) : surface;
    }
  }
  refuse("", "found points whose hull cannot be determined (", problem, "), expected none within rounding of others' planes");
}

}  // namespace carom
