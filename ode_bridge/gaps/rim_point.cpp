#include "ode_bridge/gaps/rows.h"

// u = (1 - d d^T)(P - C)/|..|, p = C + rho u, w = p - P, phi = |w| - r, n = w/|w|.
namespace carom::gaps {
namespace {

struct Nearest {
  double height;  // of P along d
  double across;  // distance of P from the axis
  Vec3 u, w;
};

Nearest nearest(const WorldFeature& f, const WorldFeature& g) {
  const Vec3 to = g.point - f.point;
  const double height = f.direction.dot(to);
  const Vec3 a = to - height * f.direction;
  const double across = a.norm();
  const Vec3 u = a / across;
  return {height, across, u, f.rim * u - to};
}

}  // namespace

ContactPoint rimPoint(const WorldFeature& f, const WorldFeature& g, int) {
  const Nearest at = nearest(f, g);
  const double l = at.w.norm();
  const Vec3 n = at.w / l;
  return {l > 0 ? l - g.radius : n.x(), n, f.point + f.rim * at.u};
}

FeatureJacobian rimPointJacobian(const WorldFeature& f, const WorldFeature& g, int) {
  FeatureJacobian J = FeatureJacobian::Zero();
  const Nearest at = nearest(f, g);
  const Vec3 &d = f.direction, &u = at.u, t = d.cross(u);
  const double l = at.w.norm(), turn = f.rim / at.across;
  const Vec3 n = at.w / l;
  auto dp = J.middleRows<3>(4);
  dp.middleCols<3>(kP1) = Mat3::Identity() - turn * t * t.transpose();
  dp.middleCols<3>(kD1) = -f.rim * d * u.transpose() - turn * at.height * t * t.transpose();
  dp.col(kRim1) = u;
  dp.middleCols<3>(kP2) = turn * t * t.transpose();
  Eigen::Matrix<double, 3, 2 * kSide> dw = dp;
  dw.middleCols<3>(kP2) -= Mat3::Identity();
  J.middleRows<3>(1) = (Mat3::Identity() - n * n.transpose()) / l * dw;
  J.row(0) = n.transpose() * dw;
  J(0, kR2) = -1;
  return J;
}

}  // namespace carom::gaps
