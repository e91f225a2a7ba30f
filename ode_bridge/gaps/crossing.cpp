#include "ode_bridge/gaps/crossing.h"

namespace carom::gaps {
namespace {

using ThreeRows = Eigen::Matrix<double, 3, 2 * kSide>;
using OneRow = Eigen::Matrix<double, 1, 2 * kSide>;

bool isRim(const CurvePoint& c) { return c.u != Vec3::Zero(); }

// Rates of the point and of the tangent at a fixed place on the curve. With the axis of a rim u and t tip over:
// du = -d (u.dd), dt = -d (t.dd).
void addFixed(const CurvePoint& c, int column, double sign, ThreeRows& point, ThreeRows& tangent) {
  const Vec3& d = c.feature->direction;
  point.middleCols<3>(column) = sign * Mat3::Identity();
  if (isRim(c)) {
    point.middleCols<3>(column + 3) = -sign * c.feature->rim * d * c.u.transpose();
    point.col(column + 7) = sign * c.u;
    tangent.middleCols<3>(column + 3) = -d * c.tangent.transpose();
  } else {
    point.middleCols<3>(column + 3) = sign * c.s * Mat3::Identity();
    tangent.middleCols<3>(column + 3).setIdentity();
  }
}

// dt by arc length.
Vec3 bend(const CurvePoint& c) { return isRim(c) ? Vec3(-c.u / c.feature->rim) : Vec3(Vec3::Zero()); }

struct Rates {
  ThreeRows fixed_w;           // of w, both places on the curves held
  ThreeRows w, point, t1, t2;  // with the places that follow: w.t_1 = w.t_2 = 0
};

// Arc lengths a_1, a_2 of the places: (w.t_1)' = (w.t_2)' = 0 is a 2 x 2 system in a_1', a_2'.
Rates ratesOf(const CurvePoint& f, const CurvePoint& g) {
  Rates r;
  r.fixed_w.setZero(), r.t1.setZero(), r.t2.setZero();
  addFixed(f, kP1, 1, r.fixed_w, r.t1);
  addFixed(g, kP2, -1, r.fixed_w, r.t2);
  const Vec3 w = f.point - g.point, bend1 = bend(f), bend2 = bend(g);
  const double cosine = f.tangent.dot(g.tangent);
  const double m11 = 1 + w.dot(bend1), m12 = -cosine, m21 = cosine, m22 = w.dot(bend2) - 1;
  const OneRow g1 = f.tangent.transpose() * r.fixed_w + w.transpose() * r.t1;
  const OneRow g2 = g.tangent.transpose() * r.fixed_w + w.transpose() * r.t2;
  const double det = m11 * m22 - m12 * m21;
  const OneRow a1 = (m12 * g2 - m22 * g1) / det, a2 = (m21 * g1 - m11 * g2) / det;
  r.w = r.fixed_w + f.tangent * a1 - g.tangent * a2;
  r.point = f.tangent * a1;
  r.point.leftCols<kSide>() += r.fixed_w.leftCols<kSide>();
  r.t1 += bend1 * a1;
  r.t2 += bend2 * a2;
  return r;
}

}  // namespace

ContactPoint sharpCrossing(const CurvePoint& f, const CurvePoint& g, int sign) {
  const Vec3 c = f.tangent.cross(g.tangent);
  const Vec3 n = (sign < 0 ? -1 : 1) / c.norm() * c;
  return {n.dot(f.point - g.point), n, f.point};
}

FeatureJacobian sharpCrossingJacobian(const CurvePoint& f, const CurvePoint& g, int sign) {
  const Rates r = ratesOf(f, g);
  const Vec3 c = f.tangent.cross(g.tangent);
  const double along = (sign < 0 ? -1 : 1) / c.norm();
  const Vec3 n = along * c;
  FeatureJacobian J;
  J.row(0) = n.transpose() * r.fixed_w;
  J.middleRows<3>(1) =
      along * (Mat3::Identity() - n * n.transpose()) * (skew(f.tangent) * r.t2 - skew(g.tangent) * r.t1);
  J.middleRows<3>(4) = r.point;
  return J;
}

ContactPoint sweptCrossing(const CurvePoint& f, const CurvePoint& g) {
  const Vec3 w = f.point - g.point;
  const double l = w.norm();
  const Vec3 n = w / l;
  return {l > 0 ? l - g.feature->radius : n.x(), n, f.point};
}

FeatureJacobian sweptCrossingJacobian(const CurvePoint& f, const CurvePoint& g) {
  const Rates r = ratesOf(f, g);
  const Vec3 w = f.point - g.point;
  const double l = w.norm();
  const Vec3 n = w / l;
  FeatureJacobian J;
  J.row(0) = n.transpose() * r.fixed_w;
  J(0, kR2) -= 1;
  J.middleRows<3>(1) = (Mat3::Identity() - n * n.transpose()) / l * r.w;
  J.middleRows<3>(4) = r.point;
  return J;
}

}  // namespace carom::gaps
