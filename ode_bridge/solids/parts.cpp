// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

template <class T>
int count(const std::vector<T>& v) {
  return static_cast<int>(v.size());
}

}  // namespace

PartMaker::PartMaker(Solid& solid, const Placement& at, const char* kind, const SolidKind& row) : solid_(solid), at_(at) {
  Part part;
  part.axes = at.axes;
  part.origin = at.origin;
  part.first_dimension = at.first_dimension;
  part.name = at.name;
  part.kind = kind;
  part.row = &row;
  part.first_vertex = count(solid.vertices);
  part.first_edge = count(solid.edges);
  part.first_face = count(solid.faces);
  part.first_rim = count(solid.rims);
  solid.parts.push_back(std::move(part));
}

void PartMaker::dimension(const Vec3& stretch, double swept, double rim, double apex) {
  solid_.parts.back().stretches.push_back({stretch, swept, rim, apex});
}

template <class F>
F& PartMaker::place(std::vector<F>& family, const Vec3& p, const Vec3& direction) {
  F& f = family.emplace_back();
  f.point = at_.point(p);
  f.direction = at_.direction(direction);
  f.part = count(solid_.parts) - 1;
  return f;
}

int PartMaker::vertex(const Vec3& p, double radius) {
  place(solid_.vertices, p, Vec3::Zero()).radius = radius;
  return count(solid_.vertices) - 1;
}

void PartMaker::marks(double radius, double z) {
  for (const Vec3& p : {Vec3(radius, 0, z), Vec3(0, radius, z), Vec3(-radius, 0, z), Vec3(0, -radius, z)})
    solid_.vertices[static_cast<std::size_t>(vertex(p))].mark = true;
}

SolidEdge& PartMaker::edge(const Vec3& middle, const Vec3& direction, double half_length) {
  SolidEdge& e = place(solid_.edges, middle, direction);
  e.half_length = half_length;
  return e;
}

SolidFace& PartMaker::face(const Vec3& p, const Vec3& normal) {
  SolidFace& f = place(solid_.faces, p, normal);
  f.first = count(solid_.corners);
  return f;
}

void PartMaker::rim(const Vec3& center, const Vec3& normal, double radius) {
  place(solid_.rims, center, normal).rim = radius;
}

void PartMaker::corner(int vertex) {
  solid_.corners.push_back(vertex);
  ++solid_.faces.back().count;
}

Piece& PartMaker::piece(Piece::Core core, const Vec3& middle) {
  Piece& p = solid_.pieces.emplace_back();
  p.core = core;
  p.center = at_.point(middle);
  p.axis = at_.direction(Vec3::UnitZ());
  return p;
}

Piece::Range PartMaker::list(int first, int number) {
  const Piece::Range range{count(solid_.piece_features), number};
  for (int i = 0; i < number; ++i) solid_.piece_features.push_back(first + i);
  return range;
}

void PartMaker::takeAll(Piece& p) {
  const Part& own = part();
  p.vertices = list(own.first_vertex, count(solid_.vertices) - own.first_vertex);
  p.edges = list(own.first_edge, count(solid_.edges) - own.first_edge);
  p.faces = list(own.first_face, count(solid_.faces) - own.first_face);
  p.rims = list(own.first_rim, count(solid_.rims) - own.first_rim);
  if (p.core != Piece::Core::frustum && p.core != Piece::Core::half_space) {
    p.points = {count(solid_.points), p.vertices.count};
    for (std::size_t v = static_cast<std::size_t>(own.first_vertex); v < solid_.vertices.size(); ++v)
      solid_.points.push_back(solid_.vertices[v].point);
  }
  p.reach = coreReach(solid_, p, p.center);
}

}  // namespace carom::solids
