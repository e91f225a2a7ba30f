// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/tapered.hpp"

// phi = n.(P - A) - r_1, n = sigma w/|w| + tau d, w = (1 - d d^T)(P - A), p = P - r_1 n.
namespace carom::gaps {

ContactPoint pointTapered(const WorldFeature& f, const WorldFeature& g) {
  const BeforeTaper<double> at(f.point, Taper<double>(g));
  // On the axis w/|w| is NaN, and so is the gap.
  return {at.n.allFinite() ? at.phi - f.radius : at.n.x(), at.n, f.point - f.radius * at.n};
}

template <class S>
JacobianOf<S> pointTaperedJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g) {
  const Taper<S> cone(g);
  const BeforeTaper<S> at(f.point, cone);
  JacobianOf<S> J = JacobianOf<S>::Zero();
  J.template block<1, 3>(0, kP1) = at.n.transpose();
  J(0, kR1) = -1;
  J.template block<3, 3>(1, kP1) = at.n_by_point;
  J.template block<3, 3>(4, kP1) = M3<S>::Identity() - f.radius * at.n_by_point;
  J.template block<3, 1>(4, kR1) = -at.n;
  Eigen::Matrix<S, 7, 7> by;
  by.template topRows<4>() = at.by_taper;
  by.template bottomRows<3>() = -f.radius * at.by_taper.template bottomRows<3>();
  foldTaper<S, 7>(g, cone, by, J.template middleCols<kSide>(kP2));
  return J;
}
template JacobianOf<double> pointTaperedJacobian<double>(const WorldFeature&, const WorldFeature&);
template JacobianOf<Rate4> pointTaperedJacobian<Rate4>(const FeatureOf<Rate4>&, const FeatureOf<Rate4>&);

}  // namespace carom::gaps
