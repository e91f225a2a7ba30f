// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/contact_source.h"

namespace carom {

/// One condition for a contact to be at its features, and not at adjacent ones:
///   point_weight . (R^T (p - x) - border) + normal_weight . R^T n >= 0
/// with the contact point p and the normal n (from b to a) in world axes, (x, R) the Pose of `body`. Weights are unit
/// or zero, so that the value is a length or a sine.
struct FeatureLimit {
  int body = -1;  ///< the one whose feature is left
  Vec3 point_weight = Vec3::Zero();   ///< of the contact point, unit or zero
  Vec3 border = Vec3::Zero();         ///< m, in the axes of the body
  Vec3 normal_weight = Vec3::Zero();  ///< of the normal, unit or zero
  Eigen::Matrix3Xd border_rates;  ///< of `border` with respect to the dimensions of the body; empty if independent of them
  Eigen::Matrix3Xd normal_rates;  ///< of `normal_weight` likewise; empty if its direction is constant
  double radius = 0;         ///< m, of a circular boundary: its weight rotates as the contact point moves along it; or 0
  Vec3 axis = Vec3::Zero();  ///< of that circle, a unit vector
  /// The contact continues on the adjacent features without a jump. Otherwise, for a limit on the normal, the bodies
  /// touch at another point there.
  bool rolls_over = false;
  std::string beyond;             ///< what the contact reaches: "the border of face +z"
};

/// Optional extension of a ContactGeometry beyond the gaps of given features; a geometry that has it also derives
/// from this class. Immutable.
class BodyGeometry {
 public:
  virtual ~BodyGeometry() = default;

  /// Bounding radius of the body about Pose::x, m; infinite for a half space.
  virtual double boundingRadius(int body) const = 0;
  /// Penetration depth of two bodies, m, along the direction of smallest depth as far as that is known; 0 if they do
  /// not overlap.
  virtual double overlap(int a, int b, const Pose& A, const Pose& B) const = 0;
  /// Conditions for a contact to stay at these features: the boundaries of faces and edges, and the normal cones of
  /// vertices, edges and rims. Other parts of a compound are not considered.
  virtual std::vector<FeatureLimit> limits(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const = 0;
};

}  // namespace carom
