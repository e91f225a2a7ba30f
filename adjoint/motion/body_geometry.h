// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/contact_source.h"

namespace carom {

/// One condition under which a contact is at the features that it is said to be at, and not at those beside them:
///   point_weight . (R^T (p - x) - border) + normal_weight . R^T n >= 0
/// with the contact point p and the normal n (from b to a) in world axes, (x, R) the Pose of `body`. Weights are unit
/// or zero, so that the value is a length or a sine.
struct FeatureLimit {
  int body = -1;  ///< the one whose feature is left
  Vec3 point_weight = Vec3::Zero();   ///< of the contact point, unit or zero
  Vec3 border = Vec3::Zero();         ///< m, in the axes of the body
  Vec3 normal_weight = Vec3::Zero();  ///< of the normal, unit or zero
  Eigen::Matrix3Xd border_rates;  ///< of `border` by the dimensions of the body; none where it has no part
  Eigen::Matrix3Xd normal_rates;  ///< of `normal_weight` likewise; none where it keeps its direction
  double radius = 0;         ///< m, of a border that is a circle: its weight turns as the contact point goes round; or 0
  Vec3 axis = Vec3::Zero();  ///< of that circle, a unit vector
  /// The contact goes over to the features beside without a jump. Else, of a limit by the normal, another place of the
  /// bodies comes into touch there.
  bool rolls_over = false;
  std::string beyond;             ///< what the contact moves to: "the border of face +z"
};

/// What a ContactGeometry may know beyond the gaps of frozen features. Optional: a geometry that knows it is of this
/// class too. Immutable.
class BodyGeometry {
 public:
  virtual ~BodyGeometry() = default;

  /// Radius of a ball about Pose::x that holds the body, m; infinite for a half space.
  virtual double boundingRadius(int body) const = 0;
  /// How deep two bodies overlap, m, along the direction that parts them soonest as far as that is known; 0 when they
  /// do not.
  virtual double overlap(int a, int b, const Pose& A, const Pose& B) const = 0;
  /// Conditions under which the contact of a frozen feature pair stays with these features: the borders of faces and
  /// edges, and the normals that a vertex, an edge or a rim can have. Other parts of a compound are not looked at.
  virtual std::vector<FeatureLimit> limits(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const = 0;
};

}  // namespace carom
