#include "ode_bridge/gaps/rows.h"

// phi = N.(P - Q) - r, n = N, p = P - r n; N = -direction of the face for sign < 0, which is the back of a sheet.
namespace carom::gaps {

ContactPoint pointPlane(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Vec3 N = sign < 0 ? Vec3(-g.direction) : g.direction;
  return {N.dot(f.point - g.point) - f.radius, N, f.point - f.radius * N};
}

FeatureJacobian pointPlaneJacobian(const WorldFeature& f, const WorldFeature& g, int sign) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const double side = sign < 0 ? -1 : 1;
  const Vec3 N = side * g.direction;
  J.block<1, 3>(0, kP1) = N.transpose();
  J.block<1, 3>(0, kP2) = -N.transpose();
  J.block<1, 3>(0, kD2) = side * (f.point - g.point).transpose();
  J(0, kR1) = -1;
  J.block<3, 3>(1, kD2) = side * Mat3::Identity();
  J.block<3, 3>(4, kP1).setIdentity();
  J.block<3, 3>(4, kD2) = -side * f.radius * Mat3::Identity();
  J.block<3, 1>(4, kR1) = -N;
  return J;
}

}  // namespace carom::gaps
