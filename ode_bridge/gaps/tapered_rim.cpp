// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "ode_bridge/gaps/tapered.hpp"
#include "ode_bridge/gaps/turns.hpp"

// phi of the points of the rim before the cone, p(theta) = C + rho u_1, is least where G = n.t_1 = 0: phi' = rho G, and
// with N = dn/dP, which is symmetric across n, G' = rho t_1.N t_1 - n.u_1. Level sets of phi are cones, which a circle
// meets in four points at most: there are two minima at most.
namespace carom::gaps {
namespace {

template <class S>
struct RimBeforeTaper {
  const FeatureOf<S>& rim;
  Taper<S> cone;
  V3<S> p, v;  // in the plane of the rim

  // `across` is a constant: p follows the plane of the rim, and nothing else.
  RimBeforeTaper(const FeatureOf<S>& f, const FeatureOf<S>& g, const Vec3& across) : rim(f), cone(g) {
    const V3<S> start = across.template cast<S>();
    const V3<S> flat = start - f.direction.dot(start) * f.direction;
    p = flat / flat.norm();
    v = f.direction.cross(p);
  }

  struct Place {
    V3<S> u, tangent, point;
  };
  template <class Number>
  Place place(const Turn<Number>& t) const {
    const V3<S> u = t.c * p + t.s * v;
    return {u, rim.direction.cross(u), rim.point + rim.rim * u};
  }
  Slope<S> slope(const Turn<double>& t) const {
    const Place at = place(t);
    const BeforeTaper<S> before(at.point, cone);
    return {before.n.dot(at.tangent), rim.rim * at.tangent.dot(before.n_by_point * at.tangent) - before.n.dot(at.u)};
  }
};

double chosenTheta(const RimBeforeTaper<double>& rim, int sign) {
  const Minima minima = minimaOf(rim);
  if (minima.count < 2) return minima.theta[0];
  const auto along = [&](double theta) { return rim.cone.axis.dot(rim.place(Turn<double>(theta)).point); };
  const bool second_is_further = along(minima.theta[1]) > along(minima.theta[0]);
  return (std::abs(sign) == 2) == second_is_further ? minima.theta[1] : minima.theta[0];
}

template <class S>
typename RimBeforeTaper<S>::Place placeOn(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  const WorldFeature &rim = valueOf(f), &cone = valueOf(g);
  const Vec3 across = rim.direction.unitOrthogonal();
  const double theta = chosenTheta(RimBeforeTaper<double>(rim, cone, across), sign);
  const RimBeforeTaper<S> curve(f, g, across);
  const Slope<S> slope = curve.slope(Turn<double>(theta));
  return curve.place(Turn<S>(followed(theta, slope.G, slope.second)));
}

}  // namespace

ContactPoint rimTapered(const WorldFeature& f, const WorldFeature& g, int sign) {
  const auto at = placeOn<double>(f, g, sign);
  const BeforeTaper<double> before(at.point, Taper<double>(g));
  return {before.n.allFinite() ? before.phi : before.n.x(), before.n, at.point};
}

// (n.t_1)' = 0 gives how far the point moves along the rim.
template <class S>
JacobianOf<S> rimTaperedJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  const auto at = placeOn<S>(f, g, sign);
  const Taper<S> cone(g);
  const BeforeTaper<S> before(at.point, cone);
  const V3<S>&d = f.direction, &n = before.n, &t = at.tangent;
  using DoubleDouble = Eigen::Matrix<S, 3, 2 * kSide>;
  DoubleDouble point = DoubleDouble::Zero();  // of a fixed place of the rim
  point.template middleCols<3>(kP1).setIdentity();
  point.template middleCols<3>(kD1) = -f.rim * d * at.u.transpose();
  point.col(kRim1) = at.u;
  Eigen::Matrix<S, 4, 2 * kSide> by_cone = Eigen::Matrix<S, 4, 2 * kSide>::Zero();
  foldTaper<S, 4>(g, cone, before.by_taper, by_cone.template middleCols<kSide>(kP2));
  JacobianOf<S> J;
  J.row(0) = n.transpose() * point + by_cone.row(0);
  J.template middleRows<3>(1) = before.n_by_point * point + by_cone.template bottomRows<3>();
  const V3<S> turn = before.n_by_point * t;
  const S bend = t.dot(turn) - n.dot(at.u) / f.rim;
  Eigen::Matrix<S, 1, 2 * kSide> along = t.transpose() * J.template middleRows<3>(1);
  along.template segment<3>(kD1) -= n.dot(d) * t.transpose();
  along *= S(-1) / bend;
  J.template middleRows<3>(1) += turn * along;
  J.template middleRows<3>(4) = point + t * along;
  return J;
}
template JacobianOf<double> rimTaperedJacobian<double>(const WorldFeature&, const WorldFeature&, int);
template JacobianOf<Rate4> rimTaperedJacobian<Rate4>(const FeatureOf<Rate4>&, const FeatureOf<Rate4>&, int);

}  // namespace carom::gaps
