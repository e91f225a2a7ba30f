// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/tapered.hpp"

// phi = |w| - r_1 - r_2, w = (1 - d d^T)(P - Q), n = w/|w|, p = P - r_1 n.
namespace carom::gaps {

ContactPoint pointEdge(const WorldFeature& f, const WorldFeature& g, int) {
  if (g.apex > 0) return pointTapered(f, g);
  const Vec3 to = f.point - g.point, w = to - g.direction.dot(to) * g.direction;
  const double l = w.norm();
  const Vec3 n = w / l;
  // On the line of the edge w/|w| is NaN, and the gap must say so too.
  return {l > 0 ? l - f.radius - g.radius : n.x(), n, f.point - f.radius * n};
}

template <class S>
JacobianOf<S> pointEdgeJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int) {
  if (g.apex > 0) return pointTaperedJacobian<S>(f, g);
  JacobianOf<S> J = JacobianOf<S>::Zero();
  const V3<S>&d = g.direction, to = f.point - g.point;
  const S t = d.dot(to);
  const V3<S> w = to - t * d;
  const S l = w.norm();
  const V3<S> n = w / l;
  const M3<S> across = (M3<S>::Identity() - n * n.transpose()) / l;
  const M3<S> dw_dP = M3<S>::Identity() - d * d.transpose();
  const M3<S> dw_dd = -t * M3<S>::Identity() - d * to.transpose();
  J.template block<1, 3>(0, kP1) = n.transpose();
  J.template block<1, 3>(0, kP2) = -n.transpose();
  J.template block<1, 3>(0, kD2) = -t * n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  J.template block<3, 3>(1, kP1) = across * dw_dP;
  J.template block<3, 3>(1, kP2) = -across * dw_dP;
  J.template block<3, 3>(1, kD2) = across * dw_dd;
  J.template middleRows<3>(4) = -f.radius * J.template middleRows<3>(1);
  J.template block<3, 3>(4, kP1) += M3<S>::Identity();
  J.template block<3, 1>(4, kR1) -= n;
  return J;
}
CAROM_GAP_JACOBIAN(pointEdgeJacobian);

}  // namespace carom::gaps
