// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

constexpr double kFlat = 1e-9;  // sine of the bend up to which an edge is not one: its faces touch whatever it touches

// Centre of the smallest ball about a triangle: half way along the longest side where the angle opposite is 90 degrees
// or more, of equal distance to all corners otherwise.
Vec3 middleOf(const std::array<Vec3, 3>& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    if ((a - c).dot(b - c) <= 0) return 0.5 * (a + b);
  }
  const Vec3 u = p[1] - p[0], v = p[2] - p[0], normal = u.cross(v);
  return p[0] + (u.squaredNorm() * v - v.squaredNorm() * u).cross(normal) * (0.5 / normal.squaredNorm());
}

// The edges of each triangle: number i joins its corners i and i + 1.
std::vector<std::array<int, 3>> edgesOfFaces(const Surface& s) {
  std::vector<std::array<int, 3>> edges(s.faces.size());
  const auto put = [&](int face, int start, int edge) {
    const auto f = static_cast<std::size_t>(face);
    const int* corners = s.corners.data() + s.faces[f].first;
    for (std::size_t i = 0; i < 3; ++i)
      if (corners[i] == start) edges[f][i] = edge;
  };
  for (std::size_t e = 0; e < s.edges.size(); ++e) {
    put(s.edges[e].left, s.edges[e].from, static_cast<int>(e));
    if (s.edges[e].right >= 0) put(s.edges[e].right, s.edges[e].to, static_cast<int>(e));
  }
  return edges;
}

void addTriangle(PartMaker& part, int face, const int* corners, const std::array<int, 3>& edges) {
  Solid& solid = part.solid();
  const Part& own = part.part();
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p[i] = solid.vertices[static_cast<std::size_t>(own.first(Family::vertex) + corners[i])].point;
  Piece& piece = part.piece(Piece::Core::triangle, Vec3::Zero());
  piece.center = middleOf(p);
  piece.points = {static_cast<int>(solid.points.size()), 3};
  solid.points.insert(solid.points.end(), p.begin(), p.end());
  for (std::size_t i = 0; i < 3; ++i) part.take(piece, Family::vertex, own.first(Family::vertex) + corners[i]);
  for (std::size_t i = 0; i < 3; ++i) part.take(piece, Family::edge, own.first(Family::edge) + edges[i]);
  part.take(piece, Family::face, own.first(Family::face) + face);
  piece.core_radius = coreRadius(solid, piece, piece.center);
}

// A piece is a triangle; triangles share vertices and edges.
void addMesh(PartMaker& part, const Mesh& s) {
  const Surface& surface = *s.surface;
  Solid& solid = part.solid();
  addSurface(part, surface, s.scale);
  const auto first_edge = static_cast<std::size_t>(part.part().first(Family::edge));
  const auto first_face = static_cast<std::size_t>(part.part().first(Family::face));
  for (std::size_t e = 0; e < surface.edges.size(); ++e)
    solid.edges[first_edge + e].convex = surface.edges[e].right < 0 || surface.edges[e].bend > kFlat;
  for (std::size_t f = first_face; f < solid.faces.size(); ++f) solid.faces[f].open = !surface.closed;
  if (surface.closed) solid.closed_mesh = true;

  solid.pieces.reserve(solid.pieces.size() + surface.faces.size());
  solid.points.reserve(solid.points.size() + 3 * surface.faces.size());
  solid.piece_features.reserve(solid.piece_features.size() + 7 * surface.faces.size());
  const std::vector<std::array<int, 3>> edges = edgesOfFaces(surface);
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    addTriangle(part, static_cast<int>(f), surface.corners.data() + surface.faces[f].first, edges[f]);
}

}  // namespace

SolidKind solidRow(KindOf<Mesh>) { return {.add = addPart<Mesh, addMesh>, .name = numberedName, .numbered = true}; }

}  // namespace carom::solids
