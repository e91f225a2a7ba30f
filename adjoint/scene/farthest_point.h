// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "adjoint/base/types.h"

namespace carom {

/// Support function of a shape along a direction n in its axes, and the support point: a corner c, with a ball of
/// radius a about it, or the rim of radius b about the unit axis k through it,
///   reach(n) = n.c + a |n| + b |n - (n.k) k|.
/// c, a and b are linear in the dimensions of the shape. While the corner stays the farthest, this is the function near n.
struct FarthestPoint {
  Vec3 corner = Vec3::Zero();   ///< c, m
  double ball = 0;              ///< a, m
  double rim = 0;               ///< b, m
  Vec3 axis = Vec3::UnitZ();    ///< k
  Eigen::Matrix3Xd corner_rates;  ///< of c with respect to each dimension
  Eigen::VectorXd ball_rates;     ///< of a with respect to each dimension
  Eigen::VectorXd rim_rates;      ///< of b with respect to each dimension
  /// How much less far the next corner extends, or the other side of the rim, m: at 0 the point is not unique.
  double margin = std::numeric_limits<double>::infinity();

  /// At a corner of a shape with so many dimensions; derivatives are 0 until they are set.
  static FarthestPoint at(const Vec3& corner, Eigen::Index dimensions);
  /// The support function along n, m for a unit vector.
  double reach(const Vec3& n) const;
  /// Its derivative with respect to n: the support point, m. Along the axis of a rim some point of it.
  Vec3 point(const Vec3& n) const;
  /// Derivative of that with respect to n.
  Mat3 bend(const Vec3& n) const;
  /// Derivative of the support function with respect to dimension d.
  double sizeRate(const Vec3& n, Eigen::Index d) const;
  /// Derivative of that with respect to n.
  Vec3 pointRate(const Vec3& n, Eigen::Index d) const;
  /// Component of n across the axis of the rim.
  Vec3 across(const Vec3& n) const { return n - n.dot(axis) * axis; }
};

}  // namespace carom
