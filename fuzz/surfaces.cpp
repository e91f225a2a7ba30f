// SPDX-License-Identifier: MIT
#include "fuzz/surfaces.h"

#include <cmath>

#include "adjoint/scene/surface.h"
#include "fuzz/require.h"
#include "ode_bridge/convex_hull.h"

namespace carom::fuzz {
namespace {

constexpr std::size_t kMostHullPoints = 2000;  // the check of a hull takes points x faces

void requireIndices(const TriangleSoup& soup) {
  for (const Vec3& v : soup.vertices) require(v.allFinite(), "finite vertices");
  for (const auto& triangle : soup.triangles)
    for (const int corner : triangle)
      require(corner >= 0 && static_cast<std::size_t>(corner) < soup.vertices.size(), "corners in range");
  require(soup.lines.empty() || soup.lines.size() == soup.triangles.size(), "a line for every triangle");
}

void requireSurface(const Surface& surface) {
  for (const Surface::Face& face : surface.faces) require(std::abs(face.normal.norm() - 1) < 1e-9, "unit normals");
  if (!surface.closed) return;
  require(std::isfinite(surface.volume) && surface.volume > 0, "a closed surface has a volume > 0");
  require(surface.center.allFinite() && surface.unit_inertia.allFinite(), "finite integrals");
}

void requireMesh(const TriangleSoup& soup) try {
  requireSurface(*meshSurface(soup.vertices, soup.triangles));
} catch (const InputError& error) {
  requireMessage(error);
}

void requireHull(const TriangleSoup& soup) try {
  const auto hull = convexHull(soup.vertices);
  requireSurface(*hull);
  require(hull->closed, "a closed hull");
  Vec3 low = soup.vertices.front(), high = low;
  for (const Vec3& v : soup.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const double tolerance = 1e-9 * (high - low).norm();
  for (const Surface::Face& face : hull->faces) {
    const Vec3& on = hull->vertices[static_cast<std::size_t>(hull->corners[static_cast<std::size_t>(face.first)])];
    for (const Vec3& v : soup.vertices) require(face.normal.dot(v - on) <= tolerance, "points within their hull");
  }
} catch (const InputError& error) {
  requireMessage(error);
}

}  // namespace

void requireSurfaces(const TriangleSoup& soup) {
  requireIndices(soup);
  requireMesh(soup);
  if (soup.vertices.size() <= kMostHullPoints) requireHull(soup);
}

}  // namespace carom::fuzz
