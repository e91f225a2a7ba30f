// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/rows.hpp"

// phi = N.(P - Q) - r, n = N, p = P - r n; N = -direction of the face for sign < 0, which is the back of a sheet.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

ContactPoint pointPlane(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Vec3 N = sign < 0 ? Vec3(-g.direction) : g.direction;
  return {N.dot(f.point - g.point) - f.radius, N, f.point - f.radius * N};
}

template <class S>
JacobianOf<S> pointPlaneJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  JacobianOf<S> J = JacobianOf<S>::Zero();
  const double side = sign < 0 ? -1 : 1;
  const V3<S> N = side * g.direction;
  J.template block<1, 3>(0, kP1) = N.transpose();
  J.template block<1, 3>(0, kP2) = -N.transpose();
  J.template block<1, 3>(0, kD2) = side * (f.point - g.point).transpose();
  J(0, kR1) = -1;
  J.template block<3, 3>(1, kD2) = side * M3<S>::Identity();
  J.template block<3, 3>(4, kP1).setIdentity();
  J.template block<3, 3>(4, kD2) = -side * f.radius * M3<S>::Identity();
  J.template block<3, 1>(4, kR1) = -N;
  return J;
}
CAROM_GAP_JACOBIAN(pointPlaneJacobian);

}  // namespace carom::gaps
