// SPDX-License-Identifier: MIT
#include "adjoint/scene/surface.h"

#include <algorithm>
#include <cassert>

#include "adjoint/base/arguments.hpp"
#include "adjoint/numeric/two_part.hpp"
#include "adjoint/numeric/double_double.hpp"
#include "adjoint/scene/polygons.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

// Twice the vector area of a polygon.
Vec3 doubleArea(const Surface& s, const Surface::Face& f) {
  Vec3 sum = Vec3::Zero();
  for (int i = 1; i + 1 < f.count; ++i) sum += crossProduct(s.corner(f, 0), s.corner(f, i), s.corner(f, i + 1));
  return sum;
}

void addEdges(Surface& s, const std::vector<HalfEdge>& halves) {
  s.closed = true;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    const HalfEdge& h = halves[i];
    Surface::Edge e{h.forward ? h.low : h.high, h.forward ? h.high : h.low, h.face, -1, 0};
    if (i + 1 < halves.size() && halves[i + 1].beside(h)) {
      assert(halves[i + 1].forward != h.forward);
      e.right = halves[++i].face;
      const Vec3 along = s.vertices[static_cast<std::size_t>(e.to)] - s.vertices[static_cast<std::size_t>(e.from)];
      const Vec3& left = s.faces[static_cast<std::size_t>(e.left)].normal;
      const Vec3& right = s.faces[static_cast<std::size_t>(e.right)].normal;
      e.bend = left.cross(right).dot(along.normalized());
    } else {
      s.closed = false;
    }
    s.edges.push_back(e);
  }
}

// Volume of the tetrahedra that a point `o` spans with the surface, 6 V = a . (b x c), and their moments about o:
//   integral of x     = sum V/4 (a + b + c)
//   integral of x x^T = sum V/20 (a a^T + b b^T + c c^T + (a + b + c)(a + b + c)^T)
struct Moments {
  double volume;
  Vec3 first;
  Mat3 second;
};

Moments momentsAbout(const Surface& s, const Vec3& o) {
  DoubleDouble volumes, firsts[3];  // of many triangles plain sums would be some roundings off
  Mat3 second = Mat3::Zero();
  for (const Surface::Face& f : s.faces) {
    const Vec3& first = s.corner(f, 0);
    const Vec3 a = first - o;
    for (int i = 1; i + 1 < f.count; ++i) {
      const Vec3 b = s.corner(f, i) - o, c = s.corner(f, i + 1) - o, sum = a + b + c;
      const double volume = tripleProduct(o, first, s.corner(f, i), s.corner(f, i + 1)) / 6;
      volumes += volume;
      for (int k = 0; k < 3; ++k) firsts[k] += volume / 4 * sum[k];
      second += volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
  }
  return {volumes.high, {firsts[0].high, firsts[1].high, firsts[2].high}, second};
}

// The moments are taken about the vertices' mean and then about the centre found, so that nothing cancels for a surface
// far from the origin.
void addIntegrals(Surface& s) {
  Vec3 o = Vec3::Zero();
  for (const Vec3& v : s.vertices) o += v / static_cast<double>(s.vertices.size());
  const Moments rough = momentsAbout(s, o);
  s.volume = rough.volume;
  if (!(s.volume > 0)) return;
  s.center = o + rough.first / rough.volume;
  const Moments m = momentsAbout(s, s.center);
  const Vec3 d = m.first / m.volume;
  const Mat3 C = m.second / m.volume - d * d.transpose();
  // trace(C) 1 - C, as sums: of a needle the difference would be rounding
  s.unit_inertia = -C;
  s.unit_inertia.diagonal() << C(1, 1) + C(2, 2), C(0, 0) + C(2, 2), C(0, 0) + C(1, 1);
}

}  // namespace

Surface assembleSurface(std::vector<Vec3> vertices, const Polygons& polygons) {
  Surface s;
  s.vertices = std::move(vertices);
  s.faces.reserve(polygons.size());
  for (const std::vector<int>& polygon : polygons) {
    if (polygon.size() < 3)
      refuseNumber("assembleSurface", "a polygon of corners", static_cast<double>(polygon.size()), "3 or more");
    for (int v : polygon) checkedIndex("assembleSurface", "vertex", v, s.vertices.size());
    Surface::Face f{static_cast<int>(s.corners.size()), static_cast<int>(polygon.size())};
    s.corners.insert(s.corners.end(), polygon.begin(), polygon.end());
    f.normal = doubleArea(s, f).stableNormalized();
    s.faces.push_back(f);
  }
  addEdges(s, halfEdges(polygons));
  if (s.closed) addIntegrals(s);
  return s;
}

}  // namespace carom
