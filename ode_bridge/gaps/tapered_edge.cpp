// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/tapered.hpp"

// n is a unit vector with n.d_1 = -tau_1 and n.d_2 = tau_2: with k = d_1.d_2, c = d_1 x d_2 and s = |c|
//   n = m +- sqrt(1 - m.m) c/s,  m = (-(tau_1 + k tau_2) d_1 + (tau_2 + k tau_1) d_2)/s^2.
// phi = n.w - r_1 - r_2 with w = A_1 - A_2; the line of surface 2 that is touched goes along e_2 = d_2 - tau_2 n, to
// p = A_2 + t_2 e_2 + r_2 n with t_2 = -w.(d_1 x n)/D, D = n.c.
namespace carom::gaps {
namespace {

template <class S>
struct Tangent {
  Taper<S> f, g;
  V3<S> c, w, n, e2;
  S D, t2;

  Tangent(const FeatureOf<S>& first, const FeatureOf<S>& second, int sign) : f(first), g(second) {
    using std::sqrt;
    c = f.axis.cross(g.axis), w = f.tip - g.tip;
    const S k = f.axis.dot(g.axis), s2 = c.squaredNorm();
    const V3<S> m = ((g.tau + k * f.tau) * g.axis - (f.tau + k * g.tau) * f.axis) / s2;
    n = m + (sign < 0 ? -1 : 1) * sqrt((1 - m.squaredNorm()) / s2) * c;
    D = n.dot(c);
    t2 = -w.dot(f.axis.cross(n)) / D;
    e2 = g.axis - g.tau * n;
  }
};

}  // namespace

ContactPoint edgeTapered(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Tangent<double> at(f, g, sign);
  return {at.n.dot(at.w) - f.radius - g.radius, at.n, at.g.tip + at.t2 * at.e2 + g.radius * at.n};
}

// d_1.dn = -dtau_1 - n.dd_1, d_2.dn = dtau_2 - n.dd_2 and n.dn = 0 give dn.
template <class S>
JacobianOf<S> edgeTaperedJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  const Tangent<S> at(f, g, sign);
  const V3<S>&d1 = at.f.axis, &d2 = at.g.axis, &n = at.n, along1 = d2.cross(n) / at.D, along2 = n.cross(d1) / at.D;
  // columns: tip, axis and tau of the first, then of the second
  Eigen::Matrix<S, 3, 14> dn = Eigen::Matrix<S, 3, 14>::Zero();
  dn.template middleCols<3>(3) = -along1 * n.transpose();
  dn.col(6) = -along1;
  dn.template middleCols<3>(10) = -along2 * n.transpose();
  dn.col(13) = along2;
  // (t_2 D)' = -(w.(d_1 x n))', D' = (n.(d_1 x d_2))'
  Eigen::Matrix<S, 1, 14> dt = (at.w.cross(d1) + at.t2 * at.c).transpose() * dn;
  dt.template segment<3>(0) += d1.cross(n).transpose();
  dt.template segment<3>(7) -= d1.cross(n).transpose();
  dt.template segment<3>(3) += (n.cross(at.w) + at.t2 * d2.cross(n)).transpose();
  dt.template segment<3>(10) += at.t2 * n.cross(d1).transpose();
  dt *= S(-1) / at.D;
  Eigen::Matrix<S, 7, 14> by;
  by.row(0) = at.w.transpose() * dn;
  by.template block<1, 3>(0, 0) += n.transpose();
  by.template block<1, 3>(0, 7) -= n.transpose();
  by.template middleRows<3>(1) = dn;
  by.template middleRows<3>(4) = at.e2 * dt + (g.radius - at.t2 * at.g.tau) * dn;
  by.template block<3, 3>(4, 7) += M3<S>::Identity();
  by.template block<3, 3>(4, 10) += at.t2 * M3<S>::Identity();
  by.template block<3, 1>(4, 13) -= at.t2 * n;
  JacobianOf<S> J = JacobianOf<S>::Zero();
  foldTaper<S, 7>(f, at.f, by.template leftCols<7>(), J.template middleCols<kSide>(kP1));
  foldTaper<S, 7>(g, at.g, by.template rightCols<7>(), J.template middleCols<kSide>(kP2));
  J(0, kR1) = J(0, kR2) = -1;
  J.template block<3, 1>(4, kR2) = n;
  return J;
}
template JacobianOf<double> edgeTaperedJacobian<double>(const WorldFeature&, const WorldFeature&, int);
template JacobianOf<Rate4> edgeTaperedJacobian<Rate4>(const FeatureOf<Rate4>&, const FeatureOf<Rate4>&, int);

}  // namespace carom::gaps
