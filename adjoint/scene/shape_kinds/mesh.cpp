// SPDX-License-Identifier: MIT
#include "adjoint/scene/shape_kinds/scaled_surface.hpp"

namespace carom::shapes {

using namespace adjoint_detail;

namespace {

std::string borderOf(const Surface& s) {
  for (const Surface::Edge& e : s.edges)
    if (e.right < 0)
      return "the edge from " + validation::text(s.vertices[static_cast<std::size_t>(e.from)]) + " to " +
             validation::text(s.vertices[static_cast<std::size_t>(e.to)]) + " has one triangle";
  return "its surface does not close";
}

void checkMesh(const Shape& shape, const validation::ShapeCheck& at) {
  const Mesh& s = as<Mesh>(shape);
  if (!s.surface) validation::fail(at.where, "no surface", "one made by meshSurface");
  if (s.surface->faces.empty()) validation::fail(at.where, "no triangles", "a triangle or more");
  for (const Surface::Face& face : s.surface->faces)
    if (face.count != 3)
      validation::fail(at.where, "a face with " + std::to_string(face.count) + " corners", "triangles alone, as meshSurface makes them");
  requireScale(at, s.scale, *s.surface);
  if (at.derived && !s.surface->closed)
    validation::fail(at.where, "an open mesh (" + borderOf(*s.surface) + ") on a moving body, whose " + at.derived,
                     "a closed mesh, or \"mass\" and \"inertia\" both written, or \"fixed\": true");
}

struct MeshRow : ScaledRow<Mesh> {
  static constexpr const char* name = "mesh";
};

}  // namespace

ShapeKind kindRow(KindOf<Mesh>) { return scaledRow<MeshRow>(checkMesh); }

}  // namespace carom::shapes
