// SPDX-License-Identifier: MIT
#include "ode_bridge/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adjoint/numeric/elementary.hpp"
#include "ode_bridge/leaf_pairs.hpp"
#include "ode_bridge/near_features.hpp"

namespace carom::ode_bridge_detail {
namespace {

// What the distance of two pieces that overlap costs.
constexpr std::size_t kStepsOfPieces = 8;

// Solid angle of a triangle seen from p (van Oosterom and Strackee, 1983).
double solidAngle(const Solid& solid, const SolidFace& face, const Vec3& p) {
  const Vec3 a = solid.corner(face, 0) - p, b = solid.corner(face, 1) - p, c = solid.corner(face, 2) - p;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * elementary::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

// Whether a closed mesh goes around p (solid's axes), by the sum of the solid angles of its triangles.
bool inside(const Solid& solid, const Vec3& p) {
  double sum = 0;
  for (const Piece& piece : solid.pieces) {
    if (piece.core != Piece::Core::triangle) continue;
    const auto f = static_cast<std::size_t>(solid.featuresOf(piece, Family::face)[0]);
    if (!solid.faces[f].open) sum += solidAngle(solid, solid.faces[f], p);
  }
  return std::abs(sum) > 2 * std::numbers::pi;
}

// Distance from p to the nearest vertex of the meshes: how deep it is inside, at most.
double depthOf(const Solid& solid, const Vec3& p) {
  double least = solid.bound();
  for (const Feature& v : solid.vertices) least = std::min(least, (v.point - p).norm());
  return least;
}

// Whether p (solid's axes) is as near as that to a triangle of a closed mesh, so that rounding says which side it is on.
bool isOnSurface(const Solid& solid, const Vec3& p, double tolerance) {
  return std::ranges::any_of(solid.pieces, [&](const Piece& piece) {
    if (piece.core != Piece::Core::triangle) return false;
    const SolidFace& face = solid.faces[static_cast<std::size_t>(solid.featuresOf(piece, Family::face)[0])];
    return std::abs(face.direction.dot(p - face.point)) <= tolerance && outsideFace(solid, face, p) <= tolerance;
  });
}

std::optional<double> insideMesh(const Placed& a, const Placed& mesh, double tolerance) {
  if (!mesh.solid->closed_mesh) return std::nullopt;
  std::optional<double> deepest;
  int part = -1;
  for (const Feature& v : a.solid->vertices) {
    if (v.part == part) continue;  // one point of each part, off the mesh, says where all of it is
    const Vec3 p = mesh.k.R.transpose() * (a.world(v.point) - mesh.k.x);
    const bool near = p.norm() < mesh.solid->bound();
    if (near && isOnSurface(*mesh.solid, p, tolerance)) continue;
    part = v.part;
    if (near && inside(*mesh.solid, p))
      deepest = std::max(deepest.value_or(0), depthOf(*mesh.solid, p));
  }
  return deepest;
}

}  // namespace

std::optional<double> overlapOf(const Placed& a, const Placed& b, double tolerance, WorkCount* work) {
  std::optional<double> deepest;
  if (work) work->step();
  eachLeafPair(a, b, 0, [&](const PlacedPiece& p, const PlacedPiece& q) {
    if (work) work->step(kStepsOfPieces);
    const double separation = findWitness(p, q).separation;
    if (separation < -tolerance) deepest = std::max(deepest.value_or(0), -separation);
  });
  if (deepest) return deepest;
  if (const auto depth = insideMesh(a, b, tolerance)) return depth;
  return insideMesh(b, a, tolerance);
}

}  // namespace carom::ode_bridge_detail
