#include "ode_bridge/gaps/rows.h"

// phi = |w| - r_1 - r_2, w = (1 - d d^T)(P - Q), n = w/|w|, p = P - r_1 n.
namespace carom::gaps {

ContactPoint pointEdge(const WorldFeature& f, const WorldFeature& g, int) {
  const Vec3 to = f.point - g.point, w = to - g.direction.dot(to) * g.direction;
  const double l = w.norm();
  const Vec3 n = w / l;
  // On the line of the edge w/|w| is NaN, and the gap must say so too.
  return {l > 0 ? l - f.radius - g.radius : n.x(), n, f.point - f.radius * n};
}

FeatureJacobian pointEdgeJacobian(const WorldFeature& f, const WorldFeature& g, int) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const Vec3 &d = g.direction, to = f.point - g.point;
  const double t = d.dot(to);
  const Vec3 w = to - t * d;
  const double l = w.norm();
  const Vec3 n = w / l;
  const Mat3 across = (Mat3::Identity() - n * n.transpose()) / l;
  const Mat3 dw_dP = Mat3::Identity() - d * d.transpose();
  const Mat3 dw_dd = -t * Mat3::Identity() - d * to.transpose();
  J.block<1, 3>(0, kP1) = n.transpose();
  J.block<1, 3>(0, kP2) = -n.transpose();
  J.block<1, 3>(0, kD2) = -t * n.transpose();
  J(0, kR1) = J(0, kR2) = -1;
  J.block<3, 3>(1, kP1) = across * dw_dP;
  J.block<3, 3>(1, kP2) = -across * dw_dP;
  J.block<3, 3>(1, kD2) = across * dw_dd;
  J.middleRows<3>(4) = -f.radius * J.middleRows<3>(1);
  J.block<3, 3>(4, kP1) += Mat3::Identity();
  J.block<3, 1>(4, kR1) -= n;
  return J;
}

}  // namespace carom::gaps
