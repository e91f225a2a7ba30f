// SPDX-License-Identifier: MIT
#include "adjoint/scene/farthest_point.h"

namespace carom {
namespace {

// The unit vector along v, and its derivative with respect to v; where v is 0, some vector across `axis`, which stays.
Vec3 directionOf(const Vec3& v, const Vec3& axis) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : axis.unitOrthogonal();
}
Mat3 directionRate(const Vec3& v) {
  const double length = v.norm();
  if (!(length > 0)) return Mat3::Zero();
  const Vec3 e = v / length;
  return (Mat3::Identity() - e * e.transpose()) / length;
}

}  // namespace

FarthestPoint FarthestPoint::at(const Vec3& corner, Eigen::Index dimensions) {
  FarthestPoint p;
  p.corner = corner;
  p.corner_rates.setZero(3, dimensions);
  p.ball_rates.setZero(dimensions), p.rim_rates.setZero(dimensions);
  return p;
}

double FarthestPoint::reach(const Vec3& n) const { return n.dot(corner) + ball * n.norm() + rim * across(n).norm(); }

Vec3 FarthestPoint::point(const Vec3& n) const {
  Vec3 p = corner;
  if (ball != 0) p += ball * n.normalized();
  if (rim != 0) p += rim * directionOf(across(n), axis);
  return p;
}

Mat3 FarthestPoint::bend(const Vec3& n) const {
  Mat3 bend = Mat3::Zero();
  if (ball != 0) bend += ball * directionRate(n);
  if (rim != 0) bend += rim * directionRate(across(n)) * (Mat3::Identity() - axis * axis.transpose());
  return bend;
}

double FarthestPoint::sizeRate(const Vec3& n, Eigen::Index d) const {
  return n.dot(corner_rates.col(d)) + ball_rates[d] * n.norm() + rim_rates[d] * across(n).norm();
}

Vec3 FarthestPoint::pointRate(const Vec3& n, Eigen::Index d) const {
  Vec3 rate = corner_rates.col(d);
  if (ball_rates[d] != 0) rate += ball_rates[d] * n.normalized();
  if (rim_rates[d] != 0) rate += rim_rates[d] * directionOf(across(n), axis);
  return rate;
}

}  // namespace carom
