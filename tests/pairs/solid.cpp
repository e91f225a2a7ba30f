// SPDX-License-Identifier: MIT
#include "tests/pairs/solid.h"

#include <algorithm>
#include <limits>

namespace carom::pairs {
namespace {

// Of what stands around a point of the piece: the swept radius, or the rim of the cap of a cylinder or cone.
Real radiusAround(const Piece& piece, const Vector& p, const Vector& from) {
  const Real far = norm(p - from);
  if (piece.kind == Piece::Kind::cone && &p == &piece.points[1]) return far;
  if (!isRound(piece)) return far + piece.radius;
  const Vector axis = unit(piece.points[1] - piece.points[0]), arm = p - from;
  const Real along = dot(arm, axis), out = norm(across(arm, axis)) + piece.radius;
  return std::sqrt(along * along + out * out);
}

Real reach(const Piece& piece, const Vector& from) {
  if (piece.kind == Piece::Kind::half_space) return std::numeric_limits<Real>::infinity();
  Real largest = 0;
  for (const Vector& p : piece.points) largest = std::max(largest, radiusAround(piece, p, from));
  return largest;
}

Vector middle(const std::vector<Vector>& points) {
  Vector low = points[0], high = points[0];
  for (const Vector& p : points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  return 0.5L * (low + high);
}

}  // namespace

Solid::Solid(const Shape& shape) : pieces(exact::piecesOf(exact::numbersOf<Real>(shape))) {
  std::vector<Vector> all;
  for (const Piece& piece : pieces) {
    const Vector centre = middle(piece.points);
    balls.push_back({centre, reach(piece, centre)});
    all.insert(all.end(), piece.points.begin(), piece.points.end());
  }
  whole.centre = middle(all);
  whole.radius = reachFrom(whole.centre);
}

Real Solid::reachFrom(const Vector& p) const {
  Real largest = 0;
  for (const Piece& piece : pieces) largest = std::max(largest, reach(piece, p));
  return largest;
}

void Placed::moveTo(const Pose& pose) {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& own = solid_->pieces[i];
    for (std::size_t k = 0; k < own.points.size(); ++k) pieces_[i].points[k] = pose * own.points[k];
    for (std::size_t k = 0; k < own.faces.size(); ++k) pieces_[i].faces[k].normal = pose.R * own.faces[k].normal;
    balls_[i].centre = pose * solid_->balls[i].centre;
  }
  whole_ = {pose * solid_->whole.centre, solid_->whole.radius};
}

}  // namespace carom::pairs
