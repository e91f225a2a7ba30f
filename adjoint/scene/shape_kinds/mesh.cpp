// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "adjoint/base/refuse.hpp"
#include "adjoint/numeric/union_find.hpp"
#include "adjoint/scene/shape_kinds/scaled_surface.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

constexpr double kFlattest = 1e-9;  // thickness of a sheet at most, of its size

/// Boundary edges that hang together bound a hole.
std::string holesOf(const Surface& s) {
  UnionFind rims(s.vertices.size());
  std::map<std::size_t, Eigen::AlignedBox3d> holes;
  for (const Surface::Edge& e : s.edges)
    if (e.right < 0) rims.join(static_cast<std::size_t>(e.from), static_cast<std::size_t>(e.to));
  for (const Surface::Edge& e : s.edges)
    if (e.right < 0)
      for (const int v : {e.from, e.to}) {
        const auto vertex = static_cast<std::size_t>(v);
        holes[rims.find(vertex)].extend(s.vertices[vertex]);
      }
  const auto widest = std::max_element(holes.begin(), holes.end(), [](const auto& a, const auto& b) {
    return a.second.sizes().norm() < b.second.sizes().norm();
  });
  if (widest == holes.end()) return "its surface does not close";
  const std::string many = holes.size() == 1 ? "a hole " : std::to_string(holes.size()) + " holes, the widest ";
  return many + about(widest->second.sizes().norm(), 3) + " m across, around " + aboutPlace(widest->second.center()) + " m";
}

/// All of it in one plane.
bool isFlat(const Surface& s) {
  double size = 0, thickness = 0;
  const Vec3 &normal = s.faces.front().normal, &corner = s.corner(s.faces.front(), 0);
  for (const Vec3& v : s.vertices) {
    size = std::max(size, (v - corner).norm());
    thickness = std::max(thickness, std::abs(normal.dot(v - corner)));
  }
  return thickness <= kFlattest * size;
}

void checkMesh(const Shape& shape, const validation::ShapeCheck& at) {
  const Mesh& s = as<Mesh>(shape);
  if (!s.surface) validation::fail(at.where, "no surface", "one made by meshSurface");
  if (s.surface->faces.empty()) validation::fail(at.where, "no triangles", "a triangle or more");
  for (const Surface::Face& face : s.surface->faces)
    if (face.count != 3)
      validation::fail(at.where, "a face with " + std::to_string(face.count) + " corners", "triangles alone, as meshSurface makes them");
  requireScale(at, s.scale, *s.surface);
  if (at.derived && isFlat(*s.surface))
    validation::fail(
        at.where, std::string("a flat sheet on a moving body, whose ") + at.derived,
        "a \"box\" as thick as the sheet is, or \"mass\" and \"inertia\" both written, or \"fixed\": true");
  if (at.derived && !s.surface->closed)
    validation::fail(at.where, "an open mesh (" + holesOf(*s.surface) + ") on a moving body, whose " + at.derived,
                     "a closed mesh, or a \"hull\" of it, or \"mass\" and \"inertia\" both written, or \"fixed\": true");
}

struct MeshRow : ScaledRow<Mesh> {
  static constexpr const char* name = "mesh";
};

}  // namespace

ShapeKind kindRow(KindOf<Mesh>) { return scaledRow<MeshRow>(checkMesh); }

}  // namespace carom::shapes
