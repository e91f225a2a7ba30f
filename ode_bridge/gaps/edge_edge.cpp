#include "ode_bridge/gaps/rows.h"

// phi = n.w - r_1 - r_2, w = Q_1 - Q_2, c = d_1 x d_2, n = +-c/|c|; the nearest point of edge 2 is Q_2 + t_2 d_2 with
// t_2 = -w.(d_1 x c)/|c|^2, and p lies r_2 n from it.
namespace carom::gaps {

ContactPoint edgeEdge(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Vec3 c = f.direction.cross(g.direction), w = f.point - g.point;
  const double s = c.norm();
  const Vec3 n = (sign < 0 ? -1 : 1) / s * c;
  const double t2 = -w.dot(f.direction.cross(c)) / (s * s);
  return {n.dot(w) - f.radius - g.radius, n, g.point + t2 * g.direction + g.radius * n};
}

FeatureJacobian edgeEdgeJacobian(const WorldFeature& f, const WorldFeature& g, int sign) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const Vec3 &d1 = f.direction, &d2 = g.direction, c = d1.cross(d2), w = f.point - g.point;
  const double s = c.norm(), s2 = s * s;
  const double along = (sign < 0 ? -1 : 1) / s;
  const Vec3 n = along * c, d1c = d1.cross(c);
  const double t2 = -w.dot(d1c) / s2;
  const Mat3 dc_dd1 = -skew(d2), dc_dd2 = skew(d1);
  const Mat3 dn_dc = along * (Mat3::Identity() - n * n.transpose());
  J.block<3, 3>(1, kD1) = dn_dc * dc_dd1;
  J.block<3, 3>(1, kD2) = dn_dc * dc_dd2;
  J.row(0) = w.transpose() * J.middleRows<3>(1);
  J.block<1, 3>(0, kP1) += n.transpose();
  J.block<1, 3>(0, kP2) -= n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  // t_2 = -w.(d_1 x c)/s2
  const Eigen::RowVector3d dt_dc = -(w.cross(d1).transpose() + 2 * t2 * c.transpose()) / s2;
  Eigen::Matrix<double, 1, 2 * kSide> dt = Eigen::Matrix<double, 1, 2 * kSide>::Zero();
  dt.segment<3>(kP1) = -d1c.transpose() / s2;
  dt.segment<3>(kP2) = d1c.transpose() / s2;
  dt.segment<3>(kD1) = -c.cross(w).transpose() / s2 + dt_dc * dc_dd1;
  dt.segment<3>(kD2) = dt_dc * dc_dd2;
  J.middleRows<3>(4) = d2 * dt + g.radius * J.middleRows<3>(1);
  J.block<3, 3>(4, kP2) += Mat3::Identity();
  J.block<3, 3>(4, kD2) += t2 * Mat3::Identity();
  J.block<3, 1>(4, kR2) += n;
  return J;
}

}  // namespace carom::gaps
