// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>

#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

// Directions are taken from the surface as it was made, so that the scale cannot change their rounding. A face's point
// is its first corner, which is a vertex exactly.
void addSurface(PartMaker& part, const Surface& s, double scale) {
  const Part own = part.part();
  Solid& solid = part.solid();
  solid.vertices.reserve(solid.vertices.size() + s.vertices.size());
  solid.faces.reserve(solid.faces.size() + s.faces.size());
  solid.corners.reserve(solid.corners.size() + s.corners.size());
  solid.edges.reserve(solid.edges.size() + s.edges.size());

  part.dimension(Vec3::Constant(1 / scale));
  for (const Vec3& v : s.vertices) part.vertex(scale * v);
  for (const Surface::Face& f : s.faces) {
    const int* corners = s.corners.data() + f.first;
    part.face(scale * s.corner(f, 0), f.normal);
    for (int i = 0; i < f.count; ++i) part.corner(own.first(Family::vertex) + corners[i]);
  }
  for (const Surface::Edge& e : s.edges) {
    const auto vertex = [&](int v) -> const Vec3& { return s.vertices[static_cast<std::size_t>(v)]; };
    const Vec3 &from = vertex(e.from), &to = vertex(e.to), along = to - from;
    SolidEdge& edge =
        part.edge(scale * (0.5 * (from + to)), along.stableNormalized(), 0.5 * scale * along.stableNorm());
    edge.from = own.first(Family::vertex) + e.from;
    edge.to = own.first(Family::vertex) + e.to;
    edge.left = own.first(Family::face) + e.left;
    if (e.right >= 0) edge.right = own.first(Family::face) + e.right;
  }
}

namespace {

void addHull(PartMaker& part, const Hull& s) {
  addSurface(part, *s.surface, s.scale);
  Eigen::AlignedBox3d box;
  for (const Vec3& v : s.surface->vertices) box.extend(v);
  part.takeAll(part.piece(Piece::Core::polytope, 0.5 * s.scale * (box.min() + box.max())));
}

}  // namespace

SolidKind solidRow(KindOf<Hull>) { return {.add = addPart<Hull, addHull>, .name = numberedName, .numbered = true}; }

}  // namespace carom::solids
