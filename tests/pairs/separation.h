// SPDX-License-Identifier: MIT
#pragma once

#include "tests/pairs/distance.h"

namespace carom::pairs {

/// A slab between two pieces: at right angles to a unit vector that points from b to a.
struct Separation {
  Real width = 0;
  Vector normal;
};

/// Width of the slab along n that has piece a on one side and b on the other; negative if n does not part them.
Real slab(const Piece& a, const Piece& b, const Vector& n);
/// The widest slab that a pair of nearest features suggests for its two pieces.
Separation separationOf(const Placed& A, const Placed& B, const Candidate& c);

/// How a body moves on from now: a point p has the velocity v + w x (p - x), the acceleration g of the whole, and one
/// that its turning gives it, of `bend` at the most.
struct Drift {
  Vector x, v, w, g;
  Real bend = 0;
};

/// A bound from below on the slab's width for the next h seconds, all of them: concave in h, and exact now. The
/// direction stays where it is, the points on either side move.
Real slabAfter(const Piece& a, const Drift& of_a, const Piece& b, const Drift& of_b, const Vector& n, Real h);

}  // namespace carom::pairs
