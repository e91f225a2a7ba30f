// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/rows.hpp"

// phi = N.(C - Q) - rho |d x N|, n = N, p = C + rho u, u = -(N - d d.N)/|N - d d.N|; N = -direction of the face for
// sign < 0. phi = N.(p - Q) where u turns so that N.t = 0, t = d x u.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

namespace {

/// From the centre of the rim to its point deepest along N. NaN where the rim lies flat.
template <class S>
V3<S> deepest(const V3<S>& d, const V3<S>& N) {
  const V3<S> x = d.cross(N);
  return d.cross(x) / x.norm();
}

}  // namespace

ContactPoint rimPlane(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Vec3 N = sign < 0 ? Vec3(-g.direction) : g.direction;
  const double sine = f.direction.cross(N).norm();
  return {N.dot(f.point - g.point) - f.rim * sine, N, f.point + f.rim * deepest<double>(f.direction, N)};
}

template <class S>
JacobianOf<S> rimPlaneJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  JacobianOf<S> J = JacobianOf<S>::Zero();
  const double side = sign < 0 ? -1 : 1;
  const S rho = f.rim;
  const V3<S>&d = f.direction, N = side * g.direction;
  const V3<S> u = deepest<S>(d, N), t = d.cross(u);
  const S cosine = N.dot(d), across = N.dot(u);
  J.template block<1, 3>(0, kP1) = N.transpose();
  J.template block<1, 3>(0, kD1) = -rho * cosine * u.transpose();
  J(0, kRim1) = across;
  J.template block<1, 3>(0, kP2) = -N.transpose();
  J.template block<1, 3>(0, kD2) = side * (f.point + rho * u - g.point).transpose();
  J.template block<3, 3>(1, kD2) = side * M3<S>::Identity();
  // u follows N in its plane, and tips over with d.
  J.template block<3, 3>(4, kP1).setIdentity();
  J.template block<3, 3>(4, kD1) = -rho * (d * u.transpose() + cosine / across * t * t.transpose());
  J.template block<3, 1>(4, kRim1) = u;
  J.template block<3, 3>(4, kD2) = side * rho / across * t * t.transpose();
  return J;
}
CAROM_GAP_JACOBIAN(rimPlaneJacobian);

}  // namespace carom::gaps
