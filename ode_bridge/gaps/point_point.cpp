// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/rows.hpp"

// phi = |w| - r_1 - r_2, w = P - Q, n = w/|w|, p = Q + r_2 n.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

ContactPoint pointPoint(const WorldFeature& f, const WorldFeature& g, int) {
  const Vec3 w = f.point - g.point;
  const double l = w.norm();
  const Vec3 n = w / l;
  // Both centres in one place: w/|w| is NaN, and the gap must say so too.
  return {l > 0 ? l - f.radius - g.radius : n.x(), n, g.point + g.radius * n};
}

template <class S>
JacobianOf<S> pointPointJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int) {
  JacobianOf<S> J = JacobianOf<S>::Zero();
  const V3<S> w = f.point - g.point;
  const S l = w.norm();
  const V3<S> n = w / l;
  const M3<S> dn = (M3<S>::Identity() - n * n.transpose()) / l;
  J.template block<1, 3>(0, kP1) = n.transpose();
  J.template block<1, 3>(0, kP2) = -n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  J.template block<3, 3>(1, kP1) = dn;
  J.template block<3, 3>(1, kP2) = -dn;
  J.template block<3, 3>(4, kP1) = g.radius * dn;
  J.template block<3, 3>(4, kP2) = M3<S>::Identity() - g.radius * dn;
  J.template block<3, 1>(4, kR2) = n;
  return J;
}
CAROM_GAP_JACOBIAN(pointPointJacobian);

}  // namespace carom::gaps
