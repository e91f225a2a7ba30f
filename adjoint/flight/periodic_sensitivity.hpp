// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/flight/rotation_sensitivity.h"

namespace carom::adjoint_detail {

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

}  // namespace carom::adjoint_detail
