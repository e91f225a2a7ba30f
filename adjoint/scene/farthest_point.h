// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "adjoint/base/types.h"

namespace carom {

/// How far a shape reaches along a direction n of its axes, and where: a corner c, with a ball of radius a about it, or
/// the rim of radius b about the unit axis k through it,
///   reach(n) = n.c + a |n| + b |n - (n.k) k|.
/// c, a and b are linear in the dimensions of the shape. While the corner stays the farthest, this is the function near n.
struct FarthestPoint {
  Vec3 corner = Vec3::Zero();   ///< c, m
  double ball = 0;              ///< a, m
  double rim = 0;               ///< b, m
  Vec3 axis = Vec3::UnitZ();    ///< k
  Eigen::Matrix3Xd corner_rates;  ///< of c by each dimension
  Eigen::VectorXd ball_rates;     ///< of a by each dimension
  Eigen::VectorXd rim_rates;      ///< of b by each dimension
  /// How much less far the next corner reaches, or the other side of the rim, m: at 0 the point is not the only one.
  double margin = std::numeric_limits<double>::infinity();

  /// At a corner of a shape with so many dimensions, whose rates are 0 until they are set.
  static FarthestPoint at(const Vec3& corner, Eigen::Index dimensions);
  /// The reach along n, m for a unit vector.
  double reach(const Vec3& n) const;
  /// Derivative of the reach by n: the point itself, m. At the middle of a rim some point of it.
  Vec3 point(const Vec3& n) const;
  /// Derivative of that by n.
  Mat3 bend(const Vec3& n) const;
  /// Derivative of the reach by dimension d.
  double sizeRate(const Vec3& n, Eigen::Index d) const;
  /// Derivative of that by n.
  Vec3 pointRate(const Vec3& n, Eigen::Index d) const;
  /// What is left of n across the axis of the rim.
  Vec3 across(const Vec3& n) const { return n - n.dot(axis) * axis; }
};

}  // namespace carom
