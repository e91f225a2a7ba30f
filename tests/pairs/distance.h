// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "tests/pairs/solid.h"

namespace carom::pairs {

/// Two features that are locally nearest.
struct Candidate {
  FeatureId a, b;
  Real distance = 0;
  Vector p, q;   ///< nearest points of a and b; where a radius is about a feature, of the feature itself
  int side = 1;  ///< as in exact::touchOf

  /// The smooth gap of the two features; nothing where they meet in no general way.
  std::optional<Touch> touch(const Placed& A, const Placed& B) const;
};

/// Distance of two solids that are apart, by comparing all features of all pieces.
struct Distance {
  Candidate nearest;
  /// A bound from below that does not lean on the enumeration: convex pieces are at least as far apart as their shadows
  /// along any direction. At the true nearest points of two pieces both are equal.
  Real proven = 0;
};
/// What is known beforehand, to save time; it does not change the result.
struct Known {
  const Candidate* hint = nullptr;  ///< pieces to begin with
  Real at_most = std::numeric_limits<Real>::infinity();
};
Distance distanceOf(const Placed& A, const Placed& B, const Known& known = {});

/// Whether every two pieces have a slab between them, however thin.
bool provenApart(const Placed& A, const Placed& B);

/// All locally nearest feature pairs within a distance.
std::vector<Candidate> candidatesWithin(const Placed& A, const Placed& B, Real distance);

/// Pieces of A and B, by number, whose balls are nearer than a distance; no others are.
std::vector<std::pair<std::size_t, std::size_t>> piecesWithin(const Placed& A, const Placed& B, Real distance);
/// The nearest features of two pieces, if they are within a distance.
std::optional<Candidate> nearestOfPieces(const Placed& A, std::size_t i, const Placed& B, std::size_t j, Real distance);

}  // namespace carom::pairs
