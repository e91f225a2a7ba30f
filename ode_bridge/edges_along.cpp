// SPDX-License-Identifier: MIT
#include "ode_bridge/edges_along.hpp"

#include <algorithm>
#include <cmath>

namespace carom::ode_bridge_detail {

namespace {

// As in touching.cpp: normals this alike are one, and edges that are more parallel than this touch along a line.
constexpr double kSame = 1e-9, kParallel = 1e-6;

// Those that lie as far out along a direction as the piece reaches, to within `room`.
std::vector<const SolidEdge*> sharpEdges(const PlacedPiece& p, const Vec3& direction, double room) {
  std::vector<const SolidEdge*> sharp;
  if (p.piece->core != Piece::Core::polytope || p.piece->radius > 0) return sharp;
  const Vec3 d = p.body->k.R.transpose() * direction;
  const double furthest = d.dot(supportOf(p.solid(), *p.piece, d).at) - room;
  for (int e : p.featuresOf(Family::edge)) {
    const SolidEdge& edge = p.solid().edges[static_cast<std::size_t>(e)];
    if (d.dot(edge.point) - edge.half_length * std::abs(d.dot(edge.direction)) < furthest) continue;
    if (edge.left >= 0 && edge.right >= 0 && edge.convex && !isSwept(edge)) sharp.push_back(&edge);
  }
  return sharp;
}

bool lieAlong(const PlacedPiece& a, const SolidEdge& e, const PlacedPiece& b, const SolidEdge& f, double tolerance, double scale) {
  const Vec3 d = a.body->k.R * e.direction, w = b.body->world(f.point) - a.body->world(e.point);
  const Vec3 other = b.body->k.R * f.direction;
  if (d.cross(other).norm() >= kParallel || (w - d.dot(w) * d).norm() > tolerance + kParallel * scale) return false;
  const double middle = d.dot(w), low = std::max(-e.half_length, middle - f.half_length),
               high = std::min(e.half_length, middle + f.half_length);
  if (!(high - low > kSame * scale)) return false;
  const auto apart = [&](double along) {
    const Vec3 to = w + (along - middle) / d.dot(other) * other - along * d;
    return to.norm();
  };
  return apart(low) <= tolerance && apart(high) <= tolerance;
}

}  // namespace

bool fallsAway(const Solid& solid, const SolidEdge& edge, const Vec3& n) {
  const auto falls = [&](int face, double along) {
    return face < 0 || n.dot(along * solid.faces[static_cast<std::size_t>(face)].direction.cross(edge.direction)) <= kSame;
  };
  return falls(edge.left, 1) && falls(edge.right, -1);
}

std::vector<Vec3> normalsAlongEdges(const PlacedPiece& a, const PlacedPiece& b, const Vec3& n, double tolerance, double scale) {
  std::vector<Vec3> normals;
  const auto offer = [&](const SolidEdge& e, const SolidEdge& f, const Vec3& n) {
    if (!fallsAway(a.solid(), e, a.body->k.R.transpose() * -n) || !fallsAway(b.solid(), f, b.body->k.R.transpose() * n)) return;
    if (std::ranges::none_of(normals, [&](const Vec3& known) { return (known - n).norm() <= kParallel; })) normals.push_back(n);
  };
  const auto normalOf = [](const PlacedPiece& p, int face) { return Vec3(p.body->k.R * p.solid().faces[static_cast<std::size_t>(face)].direction); };
  const double room = std::max(tolerance, kSame * scale);
  const std::vector<const SolidEdge*> of_a = sharpEdges(a, -n, room), of_b = sharpEdges(b, n, room);
  for (const SolidEdge* e : of_a)
    for (const SolidEdge* f : of_b) {
      if (!lieAlong(a, *e, b, *f, tolerance, scale)) continue;
      for (int face : {e->left, e->right}) offer(*e, *f, -normalOf(a, face));
      for (int face : {f->left, f->right}) offer(*e, *f, normalOf(b, face));
    }
  if (normals.size() < 2) normals.clear();
  return normals;
}

}  // namespace carom::ode_bridge_detail
