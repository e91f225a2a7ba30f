// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/base/types.h"

namespace carom {

/// Derivative of the rotation vector theta at the end of a stretch of free rotation by theta and L at its start, by the
/// principal moments, and by the products of inertia (yz, xz, xy) in principal axes, which are 0 (every one 3x3). The
/// last one is 0 unless it was asked for.
struct RotationSensitivity {
  Mat3 dtheta_dtheta = Mat3::Identity();
  Mat3 dtheta_dL = Mat3::Zero();
  Mat3 dtheta_dI = Mat3::Zero();
  Mat3 dtheta_dproducts = Mat3::Zero();
};

/// Of two stretches, the first and then the second.
RotationSensitivity chained(const RotationSensitivity& first, const RotationSensitivity& second);

/// A period of torque-free rotation: R(T) = Q R(0), where Q turns about L, and R^T L is what it was at the start.
/// A change of the start moves T by dT and the angle of Q by dphi, so a time s after n periods of the unchanged motion
///   dtheta(n T + s) = S(s) (Q^n dtheta + (1 - Q^n) (L x dL)/|L|^2) + n (dphi L/|L| - dT omega(n T + s)).
/// Made from the sensitivity over one period, n periods cost as much as one, and keep the digits that a product of n
/// factors loses.
class PeriodicSensitivity {
 public:
  /// `one`: over a period; omega at its start, in world axes, not parallel to L.
  PeriodicSensitivity(const RotationSensitivity& one, const Quat& Q, const Vec3& L, const Vec3& omega);
  /// Over n periods and `rest`, which is in world axes; `turn`: Q^n; omega at the end.
  RotationSensitivity over(double n, const Quat& turn, const RotationSensitivity& rest, const Vec3& omega) const;

 private:
  RotationSensitivity withoutGrowth(const Quat& turn) const;

  using Row = Eigen::Matrix<double, 1, 12>;  // by theta, L, I and the products
  Vec3 axis_;                                // of L
  Mat3 by_direction_;                        // (L x dL)/|L|^2 by dL
  double along_L_;                           // omega.axis, a constant
  Row dangle_, dT_;                          // dphi - dT omega.axis, and dT
};

/// Of the same stretch with everything in it turned by `turn` (about L, so that L is the same).
RotationSensitivity turned(const RotationSensitivity& S, const Quat& turn);

}  // namespace carom
