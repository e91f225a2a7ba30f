#include "ode_bridge/gaps/rows.h"

// phi = N.(C - Q) - rho |d x N|, n = N, p = C + rho u, u = -(N - d d.N)/|N - d d.N|; N = -direction of the face for
// sign < 0. phi = N.(p - Q) where u turns so that N.t = 0, t = d x u.
namespace carom::gaps {
namespace {

/// From the centre of the rim to its point deepest along N. NaN where the rim lies flat.
Vec3 deepest(const Vec3& d, const Vec3& N) {
  const Vec3 x = d.cross(N);
  return d.cross(x) / x.norm();
}

}  // namespace

ContactPoint rimPlane(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Vec3 N = sign < 0 ? Vec3(-g.direction) : g.direction;
  const double sine = f.direction.cross(N).norm();
  return {N.dot(f.point - g.point) - f.rim * sine, N, f.point + f.rim * deepest(f.direction, N)};
}

FeatureJacobian rimPlaneJacobian(const WorldFeature& f, const WorldFeature& g, int sign) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const double side = sign < 0 ? -1 : 1, rho = f.rim;
  const Vec3 &d = f.direction, N = side * g.direction;
  const Vec3 u = deepest(d, N), t = d.cross(u);
  const double cosine = N.dot(d), across = N.dot(u);
  J.block<1, 3>(0, kP1) = N.transpose();
  J.block<1, 3>(0, kD1) = -rho * cosine * u.transpose();
  J(0, kRim1) = across;
  J.block<1, 3>(0, kP2) = -N.transpose();
  J.block<1, 3>(0, kD2) = side * (f.point + rho * u - g.point).transpose();
  J.block<3, 3>(1, kD2) = side * Mat3::Identity();
  // u follows N in its plane, and tips over with d.
  J.block<3, 3>(4, kP1).setIdentity();
  J.block<3, 3>(4, kD1) = -rho * (d * u.transpose() + cosine / across * t * t.transpose());
  J.block<3, 1>(4, kRim1) = u;
  J.block<3, 3>(4, kD2) = side * rho / across * t * t.transpose();
  return J;
}

}  // namespace carom::gaps
