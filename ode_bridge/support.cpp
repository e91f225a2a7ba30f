// SPDX-License-Identifier: MIT
#include "ode_bridge/support.hpp"

#include <cmath>

namespace carom::ode_bridge_detail {

Placed::Placed(const Solid& s, const Arc& flight, double t)
    : solid(&s),
      k(flight.kinematicsAt(t)),
      acceleration(flight.acceleration()),
      variation(flight.accelerationVariation()),
      spin(s.ball ? 0 : flight.spinBound()),
      spin_rate(s.ball ? 0 : flight.spinRateBound()),
      arc(&flight) {}

Placed::Placed(const Solid& s, const Vec3& x, const Mat3& R)
    : solid(&s), k{x, R, Vec3::Zero(), Vec3::Zero()}, acceleration(Vec3::Zero()), spin(0), spin_rate(0) {}

namespace {

Support furthestPoint(const Solid& solid, const Piece& piece, const Vec3& direction) {
  const auto first = static_cast<std::size_t>(piece.points.first);
  std::size_t best = first;
  double furthest = direction.dot(solid.points[first]);
  for (std::size_t i = first + 1; i < first + static_cast<std::size_t>(piece.points.count); ++i)
    if (const double along = direction.dot(solid.points[i]); along > furthest) furthest = along, best = i;
  return {solid.points[best], static_cast<int>(best)};
}

// 2 h along > (rho_low - rho_high) across
int endOf(const Piece& piece, double along, double across) {
  return 2 * piece.half_length * along + (piece.rho_high - piece.rho) * across >= 0 ? 1 : -1;
}

Vec3 furthestOfFrustum(const Piece& piece, const Vec3& direction) {
  const double along = piece.axis.dot(direction);
  // as a double cross product it stays across the axis even where it is all rounding
  const Vec3 across = piece.axis.cross(direction).cross(piece.axis);
  const double length = across.norm();
  const bool high = endOf(piece, along, length) > 0;
  Vec3 at = piece.center + (high ? piece.half_length : -piece.half_length) * piece.axis;
  if (length > 0) at += (high ? piece.rho_high : piece.rho) / length * across;
  return at;
}

}  // namespace

int furthestEnd(const Piece& piece, const Vec3& direction) {
  return endOf(piece, piece.axis.dot(direction), piece.axis.cross(direction).cross(piece.axis).norm());
}

Support supportOf(const Solid& solid, const Piece& piece, const Vec3& direction) {
  if (piece.core == Piece::Core::frustum) return {furthestOfFrustum(piece, direction), -1};
  if (piece.core == Piece::Core::point) return {piece.center, piece.points.first};
  return furthestPoint(solid, piece, direction);
}

double extentAlong(const PlacedPiece& p, const Vec3& direction) {
  const Vec3 local = p.body->k.R.transpose() * direction;
  return local.dot(supportOf(p.solid(), *p.piece, local).at);
}

double separationAlong(const PlacedPiece& a, const PlacedPiece& b, const Vec3& n) {
  const double apart = n.dot(a.body->k.x - b.body->k.x);
  const double radii = a.piece->radius + b.piece->radius;
  const auto height = [](const PlacedPiece& p) {
    const SolidFace& face = p.solid().faces[0];
    return face.point.dot(face.direction);
  };
  if (b.halfSpace()) return apart - extentAlong(a, -n) - height(b) - radii;
  if (a.halfSpace()) return apart - height(a) - extentAlong(b, n) - radii;
  return apart - extentAlong(a, -n) - extentAlong(b, n) - radii;
}

}  // namespace carom::ode_bridge_detail
