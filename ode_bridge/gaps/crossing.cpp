// SPDX-License-Identifier: MIT
#include "ode_bridge/gaps/crossing.hpp"

namespace carom::gaps {
namespace {

template <class S>
using ThreeRows = Eigen::Matrix<S, 3, 2 * kSide>;
template <class S>
using OneRow = Eigen::Matrix<S, 1, 2 * kSide>;

template <class S>
bool isRim(const CurvePoint<S>& c) {
  return c.u != V3<S>::Zero();
}

// Rates of the point and of the tangent at a fixed place on the curve. With the axis of a rim u and t tip over:
// du = -d (u.dd), dt = -d (t.dd).
template <class S>
void addFixed(const CurvePoint<S>& c, int column, double sign, ThreeRows<S>& point, ThreeRows<S>& tangent) {
  const V3<S>& d = c.feature->direction;
  point.template middleCols<3>(column) = sign * M3<S>::Identity();
  if (isRim(c)) {
    point.template middleCols<3>(column + 3) = -sign * c.feature->rim * d * c.u.transpose();
    point.col(column + 7) = sign * c.u;
    tangent.template middleCols<3>(column + 3) = -d * c.tangent.transpose();
  } else {
    point.template middleCols<3>(column + 3) = sign * c.s * M3<S>::Identity();
    tangent.template middleCols<3>(column + 3).setIdentity();
  }
}

// dt by arc length.
template <class S>
V3<S> bend(const CurvePoint<S>& c) {
  return isRim(c) ? V3<S>(-c.u / c.feature->rim) : V3<S>(V3<S>::Zero());
}

template <class S>
struct Rates {
  ThreeRows<S> fixed_w;           // of w, both places on the curves held
  ThreeRows<S> w, point, t1, t2;  // with the places that follow: w.t_1 = w.t_2 = 0
};

// Arc lengths a_1, a_2 of the places: (w.t_1)' = (w.t_2)' = 0 is a 2 x 2 system in a_1', a_2'.
template <class S>
Rates<S> ratesOf(const CurvePoint<S>& f, const CurvePoint<S>& g) {
  Rates<S> r;
  r.fixed_w.setZero(), r.t1.setZero(), r.t2.setZero();
  addFixed<S>(f, kP1, 1, r.fixed_w, r.t1);
  addFixed<S>(g, kP2, -1, r.fixed_w, r.t2);
  const V3<S> w = f.point - g.point, bend1 = bend(f), bend2 = bend(g);
  const S cosine = f.tangent.dot(g.tangent);
  const S m11 = 1 + w.dot(bend1), m12 = -cosine, m21 = cosine, m22 = w.dot(bend2) - 1;
  const OneRow<S> g1 = f.tangent.transpose() * r.fixed_w + w.transpose() * r.t1;
  const OneRow<S> g2 = g.tangent.transpose() * r.fixed_w + w.transpose() * r.t2;
  const S det = m11 * m22 - m12 * m21;
  const OneRow<S> a1 = (m12 * g2 - m22 * g1) / det, a2 = (m21 * g1 - m11 * g2) / det;
  r.w = r.fixed_w + f.tangent * a1 - g.tangent * a2;
  r.point = f.tangent * a1;
  r.point.template leftCols<kSide>() += r.fixed_w.template leftCols<kSide>();
  r.t1 += bend1 * a1;
  r.t2 += bend2 * a2;
  return r;
}

}  // namespace

ContactPoint sharpCrossing(const CurvePoint<double>& f, const CurvePoint<double>& g, int sign) {
  const Vec3 c = f.tangent.cross(g.tangent);
  const Vec3 n = (sign < 0 ? -1 : 1) / c.norm() * c;
  return {n.dot(f.point - g.point), n, f.point};
}

template <class S>
JacobianOf<S> sharpCrossingJacobian(const CurvePoint<S>& f, const CurvePoint<S>& g, int sign) {
  const Rates<S> r = ratesOf<S>(f, g);
  const V3<S> c = f.tangent.cross(g.tangent);
  const S along = (sign < 0 ? -1 : 1) / c.norm();
  const V3<S> n = along * c;
  JacobianOf<S> J;
  J.row(0) = n.transpose() * r.fixed_w;
  J.template middleRows<3>(1) =
      along * (M3<S>::Identity() - n * n.transpose()) * (skew(f.tangent) * r.t2 - skew(g.tangent) * r.t1);
  J.template middleRows<3>(4) = r.point;
  return J;
}
template JacobianOf<double> sharpCrossingJacobian(const CurvePoint<double>&, const CurvePoint<double>&, int);
template JacobianOf<Rate4> sharpCrossingJacobian(const CurvePoint<Rate4>&, const CurvePoint<Rate4>&, int);

ContactPoint sweptCrossing(const CurvePoint<double>& f, const CurvePoint<double>& g) {
  const Vec3 w = f.point - g.point;
  const double l = w.norm();
  const Vec3 n = w / l;
  return {l > 0 ? l - g.feature->radius : n.x(), n, f.point};
}

template <class S>
JacobianOf<S> sweptCrossingJacobian(const CurvePoint<S>& f, const CurvePoint<S>& g) {
  const Rates<S> r = ratesOf<S>(f, g);
  const V3<S> w = f.point - g.point;
  const S l = w.norm();
  const V3<S> n = w / l;
  JacobianOf<S> J;
  J.row(0) = n.transpose() * r.fixed_w;
  J(0, kR2) -= 1;
  J.template middleRows<3>(1) = (M3<S>::Identity() - n * n.transpose()) / l * r.w;
  J.template middleRows<3>(4) = r.point;
  return J;
}
template JacobianOf<double> sweptCrossingJacobian(const CurvePoint<double>&, const CurvePoint<double>&);
template JacobianOf<Rate4> sweptCrossingJacobian(const CurvePoint<Rate4>&, const CurvePoint<Rate4>&);

}  // namespace carom::gaps
