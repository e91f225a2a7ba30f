// SPDX-License-Identifier: MIT
#pragma once

#include "ode_bridge/gaps/rows.hpp"

/// Gaps of tapered edges, the sides of cones. All planes tangent to one go through its apex A, and all normals out of it
/// have n.d = tau, the sine of half the opening angle. An even edge is the case tau = 0, with any point of it for A.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

template <class S>
struct Taper {
  V3<S> tip, axis;
  S tau = 0, sigma = 1;          // sine and cosine of half the opening angle
  S tau_rim = 0, tau_apex = 0;  // rates of tau by Feature::rim and Feature::apex

  explicit Taper(const FeatureOf<S>& f) : tip(f.point), axis(f.direction) {
    if (!(f.apex > 0)) return;
    using std::sqrt;
    tip += f.apex * f.direction;
    const S slant = sqrt(f.rim * f.rim + 4 * f.apex * f.apex);
    tau = f.rim / slant, sigma = 2 * f.apex / slant;
    tau_rim = sigma * sigma / slant, tau_apex = -2 * tau * sigma / slant;
  }
};

/// d(gap, normal, point) by the tip, the axis and tau of a Taper, folded into the columns of its feature.
template <class S, int rows>
void foldTaper(const FeatureOf<S>& f, const Taper<S>& taper, const Eigen::Matrix<S, rows, 7>& by,
               Eigen::Ref<Eigen::Matrix<S, rows, kSide>, 0, Eigen::OuterStride<>> columns) {
  columns.template leftCols<3>() = by.template leftCols<3>();
  columns.template middleCols<3>(3) = by.template middleCols<3>(3);
  if (!(f.apex > 0)) return;
  columns.template middleCols<3>(3) += f.apex * by.template leftCols<3>();
  columns.col(7) = taper.tau_rim * by.col(6);
  columns.col(8) = taper.tau_apex * by.col(6) + by.template leftCols<3>() * taper.axis;
}

/// A point P before a cone, and how the normal and phi = n.(P - A) there change.
template <class S>
struct BeforeTaper {
  V3<S> u, n;  // u: unit, across the axis
  S phi;
  M3<S> n_by_point;
  Eigen::Matrix<S, 4, 7> by_taper;  // of (phi, n) by tip, axis and tau

  BeforeTaper(const V3<S>& P, const Taper<S>& cone) {
    const V3<S>&d = cone.axis, to = P - cone.tip;
    const S t = d.dot(to);
    const V3<S> w = to - t * d;
    const S l = w.norm();
    u = w / l;
    n = cone.sigma * u + cone.tau * d;
    phi = cone.sigma * l + cone.tau * t;
    const M3<S> round = cone.sigma / l * (M3<S>::Identity() - u * u.transpose());
    n_by_point = round * (M3<S>::Identity() - d * d.transpose());
    by_taper.template block<1, 3>(0, 0) = -n.transpose();
    by_taper.template block<1, 3>(0, 3) = (cone.tau * l - cone.sigma * t) * u.transpose();
    by_taper(0, 6) = t - cone.tau * l / cone.sigma;
    by_taper.template block<3, 3>(1, 0) = -n_by_point;
    by_taper.template block<3, 3>(1, 3) =
        round * (-t * M3<S>::Identity() - d * to.transpose()) + cone.tau * M3<S>::Identity();
    by_taper.template block<3, 1>(1, 6) = d - cone.tau / cone.sigma * u;
  }
};

ContactPoint pointTapered(const WorldFeature& f, const WorldFeature& g);
/// One of the two tapered, or both.
ContactPoint edgeTapered(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimTapered(const WorldFeature& f, const WorldFeature& g, int sign);

template <class S>
JacobianOf<S> pointTaperedJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g);
template <class S>
JacobianOf<S> edgeTaperedJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> rimTaperedJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);

}  // namespace carom::gaps
