// SPDX-License-Identifier: MIT
#include "ode_bridge/near_features.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::ode_bridge_detail {
namespace {

bool nearEdge(const SolidEdge& edge, const Vec3& p, double distance) {
  const Vec3 to = p - edge.point;
  const double along = std::clamp(edge.direction.dot(to), -edge.half_length, edge.half_length);
  return (to - along * edge.direction).squaredNorm() <= distance * distance;
}

bool nearFace(const Solid& solid, const SolidFace& face, const Vec3& p, double distance) {
  return std::abs(face.direction.dot(p - face.point)) <= distance && outsideFace(solid, face, p) <= distance;
}

// How far a point is from the line that the side of a frustum shows from the side, less than 0 within. m
double outsideSide(const Piece& piece, double along, double out_of_axis) {
  if (piece.rho == piece.rho_high) return out_of_axis - piece.rho;
  const double rise = 2 * piece.half_length, fall = piece.rho - piece.rho_high;
  const double middle = 0.5 * (piece.rho + piece.rho_high);
  return ((out_of_axis - middle) * rise + along * fall) / std::sqrt(rise * rise + fall * fall);
}

NearFeatures nearFrustum(const Solid& solid, const Piece& piece, const Vec3& p, double distance) {
  NearFeatures out;
  const Vec3 to = p - piece.center;
  const double along = piece.axis.dot(to), out_of_axis = (to - along * piece.axis).norm();
  for (int f : solid.featuresOf(piece, Family::face)) {
    if (nearFace(solid, solid.faces[static_cast<std::size_t>(f)], p, distance)) out.add(Family::face, f);
  }
  for (int v : solid.featuresOf(piece, Family::vertex)) {
    const Feature& apex = solid.vertices[static_cast<std::size_t>(v)];
    if (!apex.mark && (apex.point - p).squaredNorm() <= distance * distance) out.add(Family::vertex, v);
  }
  if (std::abs(outsideSide(piece, along, out_of_axis)) > distance) return out;
  if (std::abs(along) <= piece.half_length + distance)
    for (int e : solid.featuresOf(piece, Family::edge)) out.add(Family::edge, e);
  for (int r : solid.featuresOf(piece, Family::rim)) {
    const Feature& rim = solid.rims[static_cast<std::size_t>(r)];
    if (std::abs(rim.direction.dot(p - rim.point)) <= distance && std::abs(out_of_axis - rim.rim) <= distance)
      out.add(Family::rim, r);
  }
  return out;
}

}  // namespace

double outsideFace(const Solid& solid, const SolidFace& face, const Vec3& p) {
  if (face.disc > 0) {
    const Vec3 to = p - face.point;
    return (to - face.direction.dot(to) * face.direction).norm() - face.disc;
  }
  double outside = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < face.count; ++i) {
    const Vec3 &from = solid.corner(face, i), along = solid.corner(face, i + 1) - from;
    outside = std::max(outside, along.cross(face.direction).dot(p - from) / along.norm());
  }
  return outside;
}

NearFeatures featuresNear(const Solid& solid, const Piece& piece, const Vec3& p, double distance) {
  if (piece.core == Piece::Core::frustum) return nearFrustum(solid, piece, p, distance);
  NearFeatures near;
  const bool few = piece.core != Piece::Core::polytope && piece.core != Piece::Core::triangle;
  for (int f : solid.featuresOf(piece, Family::face)) {
    if (few || nearFace(solid, solid.faces[static_cast<std::size_t>(f)], p, distance)) near.add(Family::face, f);
  }
  for (int e : solid.featuresOf(piece, Family::edge)) {
    if (few || nearEdge(solid.edges[static_cast<std::size_t>(e)], p, distance)) near.add(Family::edge, e);
  }
  for (int v : solid.featuresOf(piece, Family::vertex)) {
    if (few || (solid.vertices[static_cast<std::size_t>(v)].point - p).squaredNorm() <= distance * distance)
      near.add(Family::vertex, v);
  }
  return near;
}

}  // namespace carom::ode_bridge_detail
