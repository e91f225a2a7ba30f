// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/scene/shape.h"
#include "tests/support/brute/numbers.h"

namespace carom::brute {

/// Ball, cuboid or half space, in its own axes.
struct Solid {
  enum class Kind { ball, box, half_space };
  Kind kind = Kind::ball;
  Real radius = 0;
  Vector half = Vector::Zero();
  Vector normal = Vector::UnitZ();
  Real offset = 0;

  /// Radius about the origin that holds all of it (not for half spaces).
  Real reach() const { return kind == Kind::ball ? radius : half.norm(); }
};
Solid solidOf(const Shape& shape);

struct Placement {
  Vector x = Vector::Zero();
  Matrix R = Matrix::Identity();
};

/// The farthest apart that two solids are seen along the directions that decide: at most the distance, > 0 exactly when
/// they are apart; minus the penetration depth when they overlap. `n` is that direction, unit, from b to a.
struct Separation {
  Real value = 0;
  Vector n = Vector::UnitZ();
};
/// Face normals and crossed edges for boxes (separating axes); nearest points where a ball takes part.
Separation separation(const Solid& a, const Placement& A, const Solid& b, const Placement& B);

/// Where two solids that touch may be said to touch: normal from b to a, and point. More than one where several
/// directions or vertices are within `tie` metres of being the one.
struct Contact {
  Vector n, p;
};
std::vector<Contact> contactsOf(const Solid& a, const Placement& A, const Solid& b, const Placement& B, Real tie);

/// The corners of a box in the world relative to its origin; the origin alone for a ball.
std::vector<Vector> corners(const Solid& solid, const Matrix& R);

}  // namespace carom::brute
