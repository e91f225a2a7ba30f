// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>

#include "ode_bridge/gaps/rows.hpp"

/// Two curves, rims or edges, at the points where they come nearest: w = p_1 - p_2 is across both tangents t_1 and t_2.
/// What rim-edge and rim-rim share.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

/// A point of a rim or of the line of an edge.
template <class S>
struct CurvePoint {
  const FeatureOf<S>* feature;
  V3<S> point;
  V3<S> tangent;            ///< unit: d x u on a rim, d on an edge
  V3<S> u = V3<S>::Zero();  ///< rim: unit, from its centre to the point
  S s = 0;                  ///< edge: from its point, m

  static CurvePoint onRim(const FeatureOf<S>& f, const V3<S>& u) {
    return {&f, f.point + f.rim * u, f.direction.cross(u), u, 0};
  }
  static CurvePoint onEdge(const FeatureOf<S>& f, const S& s) {
    return {&f, f.point + s * f.direction, f.direction, V3<S>::Zero(), s};
  }
};

/// phi = n.w, n = +-(t_1 x t_2)/|t_1 x t_2|, p = p_1.
ContactPoint sharpCrossing(const CurvePoint<double>& f, const CurvePoint<double>& g, int sign);
template <class S>
JacobianOf<S> sharpCrossingJacobian(const CurvePoint<S>& f, const CurvePoint<S>& g, int sign);

/// Which of two places a sign picks: 1 or 2.
inline int branchOf(int sign) { return (std::abs(sign) - 1) % 2 + 1; }
/// Whether a sign is that of sharp curves taken to be apart.
inline bool isApart(int sign) { return std::abs(sign) > 2; }

/// phi = |w| - r_2, n = w/|w|, p = p_1: the second curve is swept by a ball.
ContactPoint sweptCrossing(const CurvePoint<double>& f, const CurvePoint<double>& g);
template <class S>
JacobianOf<S> sweptCrossingJacobian(const CurvePoint<S>& f, const CurvePoint<S>& g);

}  // namespace carom::gaps
