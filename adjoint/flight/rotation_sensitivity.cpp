// SPDX-License-Identifier: MIT
#include "adjoint/flight/rotation_sensitivity.h"

#include "adjoint/flight/periodic_sensitivity.hpp"
#include "adjoint/numeric/so3.hpp"

namespace carom {

using namespace adjoint_detail;

RotationSensitivity chained(const RotationSensitivity& first, const RotationSensitivity& second) {
  RotationSensitivity S;
  S.dtheta_dtheta = second.dtheta_dtheta * first.dtheta_dtheta;
  S.dtheta_dL = second.dtheta_dtheta * first.dtheta_dL + second.dtheta_dL;
  S.dtheta_dI = second.dtheta_dtheta * first.dtheta_dI + second.dtheta_dI;
  S.dtheta_dproducts = second.dtheta_dtheta * first.dtheta_dproducts + second.dtheta_dproducts;
  return S;
}

RotationSensitivity turned(const RotationSensitivity& S, const Quat& turn) {
  const Mat3 Q = turn.toRotationMatrix();
  RotationSensitivity out;
  out.dtheta_dtheta = Q * S.dtheta_dtheta * Q.transpose();
  out.dtheta_dL = Q * S.dtheta_dL * Q.transpose();
  out.dtheta_dI = Q * S.dtheta_dI;  // the moments are in body axes
  out.dtheta_dproducts = Q * S.dtheta_dproducts;
  return out;
}

// What is left of one period without growth is a vector along L and one along the part of omega that is normal to it.
PeriodicSensitivity::PeriodicSensitivity(const RotationSensitivity& one, const Quat& Q, const Vec3& L,
                                         const Vec3& omega)
    : axis_(L.normalized()), by_direction_(skew(L) / L.squaredNorm()), along_L_(axis_.dot(omega)) {
  Vec3 across = omega - along_L_ * axis_;
  across -= axis_.dot(across) * axis_;  // again: omega may be almost along the axis
  const RotationSensitivity kept = withoutGrowth(Q);
  Eigen::Matrix<double, 3, 12> grown;
  grown << one.dtheta_dtheta - kept.dtheta_dtheta, one.dtheta_dL - kept.dtheta_dL, one.dtheta_dI, one.dtheta_dproducts;
  dangle_ = axis_.transpose() * grown;
  // so near to a principal axis a change of time moves nothing, and none can be read off
  const double size = across.squaredNorm();
  dT_.setZero();
  if (size > 1e-40 * omega.squaredNorm()) dT_ = -(Q * across).transpose() * grown / size;
}

RotationSensitivity PeriodicSensitivity::withoutGrowth(const Quat& turn) const {
  RotationSensitivity S;
  S.dtheta_dtheta = turn.toRotationMatrix();
  S.dtheta_dL = (Mat3::Identity() - S.dtheta_dtheta) * by_direction_;
  return S;
}

// The growth is added at the end: directions of the flow go over into such, and would lose it to rounding on the way.
RotationSensitivity PeriodicSensitivity::over(double n, const Quat& turn, const RotationSensitivity& rest,
                                              const Vec3& omega) const {
  const Eigen::Matrix<double, 3, 12> grown = n * (axis_ * dangle_ - (omega - along_L_ * axis_) * dT_);
  RotationSensitivity S = chained(withoutGrowth(turn), rest);
  S.dtheta_dtheta += grown.middleCols<3>(0);
  S.dtheta_dL += grown.middleCols<3>(3);
  S.dtheta_dI += grown.middleCols<3>(6);
  S.dtheta_dproducts += grown.middleCols<3>(9);
  return S;
}

}  // namespace carom
