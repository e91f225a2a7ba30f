// SPDX-License-Identifier: MIT
#include "tests/pairs/separation.h"

#include <algorithm>
#include <limits>

namespace carom::pairs {
namespace {

// Largest m . (p - from) of the points that a piece is made of, its radius left out unless it is a cylinder's or cone's.
Real farthest(const Piece& piece, const Vector& m, const Vector& from) {
  Real most = -std::numeric_limits<Real>::infinity();
  for (const Vector& p : piece.points) most = std::max(most, dot(m, p - from));
  if (piece.kind == Piece::Kind::cone)
    return std::max(most, dot(m, piece.points[0] - from) +
                              piece.radius * norm(across(m, unit(piece.points[1] - piece.points[0]))));
  if (piece.kind != Piece::Kind::cylinder) return most;
  return most + piece.radius * norm(across(m, unit(piece.points[1] - piece.points[0])));
}

// The distance that the piece reaches beyond its points in all directions.
Real skin(const Piece& piece) { return piece.kind == Piece::Kind::rounded ? piece.radius : 0; }

// Highest n . p after h seconds, as seen from the origin; the radius left out as above.
Real highestAfter(const Piece& piece, const Drift& drift, const Vector& n, Real h) {
  const Vector m = n + h * cross(n, drift.w);  // n . (p + h w x p) = m . p
  return dot(n, drift.x + h * drift.v) + farthest(piece, m, drift.x) + h * h / 2 * drift.bend;
}

}  // namespace

Real slab(const Piece& a, const Piece& b, const Vector& n) { return slabAfter(a, {}, b, {}, n, 0); }

Real slabAfter(const Piece& a, const Drift& of_a, const Piece& b, const Drift& of_b, const Vector& n, Real h) {
  const Real fall = h * h / 2 * std::min(Real(0), dot(n, of_a.g - of_b.g));
  // half spaces stand still, and n is their normal
  const Real low = isHalfSpace(a) ? dot(n, a.points[0]) : -highestAfter(a, of_a, -n, h);
  const Real high = isHalfSpace(b) ? dot(n, b.points[0]) : highestAfter(b, of_b, n, h);
  return low - high - skin(a) - skin(b) + fall;
}

Separation separationOf(const Placed& A, const Placed& B, const Candidate& c) {
  const Piece &a = A.pieces()[c.a.piece], &b = B.pieces()[c.b.piece];
  Separation best{-std::numeric_limits<Real>::infinity(), {}};
  const auto look = [&](const Vector& n) {
    const Real width = slab(a, b, n);
    if (width > best.width) best = {width, n};
  };
  if (const auto touch = c.touch(A, B)) look(touch->normal);
  const Vector between = c.p - c.q;
  if (!isHalfSpace(a) && !isHalfSpace(b) && dot(between, between) > 0) look(unit(between));
  return best;
}

}  // namespace carom::pairs
