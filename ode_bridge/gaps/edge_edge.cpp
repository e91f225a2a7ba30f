// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/tapered.hpp"

// phi = n.w - r_1 - r_2, w = Q_1 - Q_2, c = d_1 x d_2, n = +-c/|c|; the nearest point of edge 2 is Q_2 + t_2 d_2 with
// t_2 = -w.(d_1 x c)/|c|^2, and p lies r_2 n from it.
namespace carom::gaps {

ContactPoint edgeEdge(const WorldFeature& f, const WorldFeature& g, int sign) {
  if (f.apex > 0 || g.apex > 0) return edgeTapered(f, g, sign);
  const Vec3 c = f.direction.cross(g.direction), w = f.point - g.point;
  const double s = c.norm();
  const Vec3 n = (sign < 0 ? -1 : 1) / s * c;
  const double t2 = -w.dot(f.direction.cross(c)) / (s * s);
  return {n.dot(w) - f.radius - g.radius, n, g.point + t2 * g.direction + g.radius * n};
}

template <class S>
JacobianOf<S> edgeEdgeJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  if (f.apex > 0 || g.apex > 0) return edgeTaperedJacobian<S>(f, g, sign);
  JacobianOf<S> J = JacobianOf<S>::Zero();
  const V3<S>&d1 = f.direction, &d2 = g.direction, c = d1.cross(d2), w = f.point - g.point;
  const S s = c.norm(), s2 = s * s;
  const S along = (sign < 0 ? -1 : 1) / s;
  const V3<S> n = along * c, d1c = d1.cross(c);
  const S t2 = -w.dot(d1c) / s2;
  const M3<S> dc_dd1 = -skew(d2), dc_dd2 = skew(d1);
  const M3<S> dn_dc = along * (M3<S>::Identity() - n * n.transpose());
  J.template block<3, 3>(1, kD1) = dn_dc * dc_dd1;
  J.template block<3, 3>(1, kD2) = dn_dc * dc_dd2;
  J.row(0) = w.transpose() * J.template middleRows<3>(1);
  J.template block<1, 3>(0, kP1) += n.transpose();
  J.template block<1, 3>(0, kP2) -= n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  // t_2 = -w.(d_1 x c)/s2
  const Eigen::Matrix<S, 1, 3> dt_dc = -(w.cross(d1).transpose() + 2 * t2 * c.transpose()) / s2;
  Eigen::Matrix<S, 1, 2 * kSide> dt = Eigen::Matrix<S, 1, 2 * kSide>::Zero();
  dt.template segment<3>(kP1) = -d1c.transpose() / s2;
  dt.template segment<3>(kP2) = d1c.transpose() / s2;
  dt.template segment<3>(kD1) = -c.cross(w).transpose() / s2 + dt_dc * dc_dd1;
  dt.template segment<3>(kD2) = dt_dc * dc_dd2;
  J.template middleRows<3>(4) = d2 * dt + g.radius * J.template middleRows<3>(1);
  J.template block<3, 3>(4, kP2) += M3<S>::Identity();
  J.template block<3, 3>(4, kD2) += t2 * M3<S>::Identity();
  J.template block<3, 1>(4, kR2) += n;
  return J;
}
CAROM_GAP_JACOBIAN(edgeEdgeJacobian);

}  // namespace carom::gaps
