// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "tests/support/exact/touch.h"

namespace carom::pairs {

/// The arithmetic of the brute-force answer.
using Real = long double;
using Vector = exact::Vec<Real>;
using Matrix = exact::Mat<Real>;
using Pose = exact::Pose<Real>;
using Piece = exact::Piece<Real>;
using Feature = exact::Feature<Real>;
using Touch = exact::Touch<Real>;
using exact::FeatureId;
using exact::FeatureKind;

inline constexpr Real kInfinite = std::numeric_limits<Real>::infinity();

/// A shape as a union of convex pieces, each in a ball.
struct Solid {
  struct Ball {
    Vector centre;
    Real radius = 0;  ///< infinite for a half space
  };
  std::vector<Piece> pieces;
  std::vector<Ball> balls;  ///< of the pieces
  Ball whole;

  explicit Solid(const Shape& shape);
  /// Radius about a point of the shape's axes that holds all of it.
  Real reachFrom(const Vector& p) const;
};

inline bool isHalfSpace(const Piece& piece) { return piece.kind == Piece::Kind::half_space; }
/// A cylinder or a cone.
inline bool isRound(const Piece& piece) { return piece.kind == Piece::Kind::cylinder || piece.kind == Piece::Kind::cone; }
inline bool isHalfSpace(const Solid& solid) { return isHalfSpace(solid.pieces[0]); }

/// A solid with all its points in the world.
class Placed {
 public:
  explicit Placed(const Solid& solid) : solid_(&solid), pieces_(solid.pieces), balls_(solid.balls) {}
  void moveTo(const Pose& pose);

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<Solid::Ball>& balls() const { return balls_; }
  const Solid::Ball& whole() const { return whole_; }

 private:
  const Solid* solid_;
  std::vector<Piece> pieces_;
  std::vector<Solid::Ball> balls_;
  Solid::Ball whole_;
};

}  // namespace carom::pairs
