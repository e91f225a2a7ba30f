// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "adjoint/base/types.h"
#include "adjoint/numeric/elementary.hpp"

namespace carom::adjoint_detail {

/// Rotation vectors: theta = angle * axis, world axes, R = exp([theta]x). Below kSmallRotation power series are used,
/// whose first neglected term is under 1e-17.
inline constexpr double kSmallRotation = 0.02;

/// Unit quaternion of a rotation vector.
inline Quat expSO3(const Vec3& u) {
  const double angle2 = u.squaredNorm(), angle = std::sqrt(angle2);
  const double h2 = angle2 / 4;
  const auto [sine, cosine] = elementary::sincos(angle / 2);
  const double s = angle < kSmallRotation ? 0.5 * (1 - h2 / 6 * (1 - h2 / 20 * (1 - h2 / 42))) : sine / angle;
  return Quat(cosine, s * u.x(), s * u.y(), s * u.z());
}

/// Rotation vector of a unit quaternion, with 0 <= angle <= pi. At pi both signs of the axis are right; the one of the
/// quaternion is given.
inline Vec3 logSO3(const Quat& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  const double sine = q.vec().norm();
  const double cosine = sign * q.w();
  if (sine < 1e-8 * cosine) return 2 * sign / cosine * q.vec();
  return sign * 2 * elementary::atan2(sine, cosine) / sine * q.vec();
}

/// Left Jacobian: exp(u + du) = exp(J du) exp(u) to first order.
///   J = I + (1 - cos a)/a^2 [u]x + (a - sin a)/a^3 [u]x^2,  a = |u|.
inline Mat3 leftJacobian(const Vec3& u) {
  const double a2 = u.squaredNorm(), a = std::sqrt(a2);
  double b, c;
  if (a < kSmallRotation) {
    b = 0.5 * (1 - a2 / 12 * (1 - a2 / 30 * (1 - a2 / 56)));
    c = (1 - a2 / 20 * (1 - a2 / 42 * (1 - a2 / 72))) / 6;
  } else {
    const double half_sine = elementary::sin(a / 2);
    b = 2 * half_sine * half_sine / a2;
    c = (a - elementary::sin(a)) / (a2 * a);
  }
  const Mat3 U = skew(u);
  return Mat3::Identity() + b * U + c * U * U;
}

/// Inverse of the left Jacobian, for |u| < 2 pi:
///   J^-1 = I - 1/2 [u]x + (1 - (a/2) cot(a/2))/a^2 [u]x^2.
inline Mat3 leftJacobianInverse(const Vec3& u) {
  const double a2 = u.squaredNorm(), a = std::sqrt(a2);
  const auto [sine, cosine] = elementary::sincos(a / 2);
  const double c = a < kSmallRotation ? (1 + a2 / 60 * (1 + a2 / 42 * (1 + a2 / 40))) / 12
                                      : (1 - a / 2 * cosine / sine) / a2;
  const Mat3 U = skew(u);
  return Mat3::Identity() - 0.5 * U + c * U * U;
}

}  // namespace carom::adjoint_detail
