// SPDX-License-Identifier: MIT
#include "adjoint/flight/flight_symmetric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/numeric/so3.hpp"

namespace carom::adjoint_detail {

Quat sphericalOrientation(double inertia, const Quat& q0, const Vec3& L, double t) {
  return (expSO3(L * (t / inertia)) * q0).normalized();
}

RotationSensitivity sphericalSensitivity(double inertia, const Vec3& L, double t) {
  const Vec3 a = L * (t / inertia);
  RotationSensitivity S;
  S.dtheta_dtheta = expSO3(a).toRotationMatrix();
  S.dtheta_dL = leftJacobian(a) * (t / inertia);
  // J_l(a) a = a, so d theta/dI = -a/I, shared by the three moments that change together
  S.dtheta_dI = -(a / (3 * inertia)) * Vec3::Ones().transpose();
  return S;
}

Quat symmetricOrientation(const Vec3& inertia, int axis, const Quat& q0, const Vec3& L, double t) {
  const double perp = inertia[(axis + 1) % 3], par = inertia[axis];
  const Vec3 e = Vec3::Unit(axis);
  const double beta = (1 / par - 1 / perp) * L.dot(q0 * e) * t;
  return (expSO3(L * (t / perp)) * q0 * expSO3(beta * e)).normalized();
}

// With a = L t / I_perp, n = R0 e, beta = (1/I_par - 1/I_perp) (L.n) t:
//   dtheta = J_l(a) da + exp(a) (dtheta0 + n dbeta),  d(L.n) = n.dL + (n x L).dtheta0.
RotationSensitivity symmetricSensitivity(const Vec3& inertia, int axis, const Quat& q0, const Vec3& L, double t) {
  const double perp = inertia[(axis + 1) % 3], par = inertia[axis], c = (1 / par - 1 / perp) * t;
  const Vec3 a = L * (t / perp), n = q0 * Vec3::Unit(axis);
  const Mat3 E = expSO3(a).toRotationMatrix();
  const Vec3 En = E * n;
  RotationSensitivity S;
  S.dtheta_dtheta = E + c * En * n.cross(L).transpose();
  S.dtheta_dL = leftJacobian(a) * (t / perp) + c * En * n.transpose();
  const Vec3 by_perp = -a / perp + En * (L.dot(n) * t / (perp * perp));
  const Vec3 by_par = -En * (L.dot(n) * t / (par * par));
  S.dtheta_dI.col(axis) = by_par;
  S.dtheta_dI.col((axis + 1) % 3) = S.dtheta_dI.col((axis + 2) % 3) = 0.5 * by_perp;
  return S;
}

int symmetryAxis(const Vec3& I) {
  const double tolerance = 4 * std::numeric_limits<double>::epsilon() * I.maxCoeff();
  const auto equal = [&](int i, int j) { return std::abs(I[i] - I[j]) <= tolerance; };
  if (equal(0, 1) && equal(1, 2)) return -1;
  for (int axis = 0; axis < 3; ++axis)
    if (equal((axis + 1) % 3, (axis + 2) % 3)) return axis;
  return 3;
}

}  // namespace carom::adjoint_detail
