// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

const Vec3& vertexOf(const Surface& s, int v) { return s.vertices[static_cast<std::size_t>(v)]; }

}  // namespace

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
    part.face(scale * vertexOf(s, corners[0]), f.normal);
    for (int i = 0; i < f.count; ++i) part.corner(own.first_vertex + corners[i]);
  }
  for (const Surface::Edge& e : s.edges) {
    const Vec3 &from = vertexOf(s, e.from), &to = vertexOf(s, e.to), along = to - from;
    SolidEdge& edge =
        part.edge(scale * (0.5 * (from + to)), along.stableNormalized(), 0.5 * scale * along.stableNorm());
    edge.from = own.first_vertex + e.from;
    edge.to = own.first_vertex + e.to;
    edge.left = own.first_face + e.left;
    if (e.right >= 0) edge.right = own.first_face + e.right;
  }
}

namespace {

void addHull(PartMaker& part, const Hull& s) {
  addSurface(part, *s.surface, s.scale);
  Vec3 low = s.surface->vertices[0], high = low;
  for (const Vec3& v : s.surface->vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  part.takeAll(part.piece(Piece::Core::polytope, 0.5 * s.scale * (low + high)));
}

}  // namespace

SolidKind solidRow(KindOf<Hull>) { return {.add = addPart<Hull, addHull>, .name = numberedName}; }

}  // namespace carom::solids
