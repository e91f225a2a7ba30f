// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/rows.hpp"

// u = (1 - d d^T)(P - C)/|..|, p = C + rho u, w = p - P, phi = |w| - r, n = w/|w|.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

namespace {

template <class S>
struct Nearest {
  S height;  // of P along d
  S across;  // distance of P from the axis
  V3<S> u, w;
};

template <class S>
Nearest<S> nearest(const FeatureOf<S>& f, const FeatureOf<S>& g) {
  const V3<S> to = g.point - f.point;
  const S height = f.direction.dot(to);
  const V3<S> a = to - height * f.direction;
  const S across = a.norm();
  const V3<S> u = a / across;
  return {height, across, u, f.rim * u - to};
}

}  // namespace

ContactPoint rimPoint(const WorldFeature& f, const WorldFeature& g, int) {
  const Nearest<double> at = nearest<double>(f, g);
  const double l = at.w.norm();
  const Vec3 n = at.w / l;
  return {l > 0 ? l - g.radius : n.x(), n, f.point + f.rim * at.u};
}

template <class S>
JacobianOf<S> rimPointJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int) {
  JacobianOf<S> J = JacobianOf<S>::Zero();
  const Nearest<S> at = nearest<S>(f, g);
  const V3<S>&d = f.direction, &u = at.u, t = d.cross(u);
  const S l = at.w.norm(), turn = f.rim / at.across;
  const V3<S> n = at.w / l;
  auto dp = J.template middleRows<3>(4);
  dp.template middleCols<3>(kP1) = M3<S>::Identity() - turn * t * t.transpose();
  dp.template middleCols<3>(kD1) = -f.rim * d * u.transpose() - turn * at.height * t * t.transpose();
  dp.col(kRim1) = u;
  dp.template middleCols<3>(kP2) = turn * t * t.transpose();
  Eigen::Matrix<S, 3, 2 * kSide> dw = dp;
  dw.template middleCols<3>(kP2) -= M3<S>::Identity();
  J.template middleRows<3>(1) = (M3<S>::Identity() - n * n.transpose()) / l * dw;
  J.row(0) = n.transpose() * dw;
  J(0, kR2) = -1;
  return J;
}
CAROM_GAP_JACOBIAN(rimPointJacobian);

}  // namespace carom::gaps
