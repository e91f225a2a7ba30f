// SPDX-License-Identifier: MIT
#include "ode_bridge/solids/parts.hpp"

namespace carom::solids {

using namespace ode_bridge_detail;

namespace {

int count(const auto& v) { return static_cast<int>(v.size()); }

}  // namespace

PartMaker::PartMaker(Solid& solid, const Placement& at, const char* kind, const SolidKind& row) : solid_(solid), at_(at) {
  Part part;
  part.axes = at.axes;
  part.origin = at.origin;
  part.first_dimension = at.first_dimension;
  part.name = at.name;
  part.kind = kind;
  part.row = &row;
  for (std::size_t f = 0; f < kFamilies.size(); ++f) part.firsts[f] = static_cast<int>(solid.count(kFamilies[f]));
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
  solid_.parts.back().box.extend(p);
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

void PartMaker::take(Piece& p, Family family, int first, int number) {
  Piece::Range& range = p.features[static_cast<std::size_t>(family)];
  if (range.count == 0) range.first = count(solid_.piece_features);
  range.count += number;
  for (int i = 0; i < number; ++i) solid_.piece_features.push_back(first + i);
}

void PartMaker::takeAll(Piece& p) {
  const Part& own = part();
  for (const Family f : kFamilies) take(p, f, own.first(f), static_cast<int>(solid_.count(f)) - own.first(f));
  if (p.core != Piece::Core::frustum && p.core != Piece::Core::half_space) {
    const std::span<const int> vertices = solid_.featuresOf(p, Family::vertex);
    p.points = {count(solid_.points), count(vertices)};
    for (int v : vertices) solid_.points.push_back(solid_.vertices[static_cast<std::size_t>(v)].point);
  }
  p.core_radius = coreRadius(solid_, p, p.center);
}

}  // namespace carom::solids
