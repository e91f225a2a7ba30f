#pragma once

#include "ode_bridge/gaps/rows.h"

/// Two curves, rims or edges, at the points where they come nearest: w = p_1 - p_2 is across both tangents t_1 and t_2.
/// What rim-edge and rim-rim share.
namespace carom::gaps {

/// A point of a rim or of the line of an edge.
struct CurvePoint {
  const WorldFeature* feature;
  Vec3 point;
  Vec3 tangent;           ///< unit: d x u on a rim, d on an edge
  Vec3 u = Vec3::Zero();  ///< rim: unit, from its centre to the point
  double s = 0;           ///< edge: from its point, m

  static CurvePoint onRim(const WorldFeature& f, const Vec3& u) {
    return {&f, f.point + f.rim * u, f.direction.cross(u), u, 0};
  }
  static CurvePoint onEdge(const WorldFeature& f, double s) {
    return {&f, f.point + s * f.direction, f.direction, Vec3::Zero(), s};
  }
};

/// phi = n.w, n = +-(t_1 x t_2)/|t_1 x t_2|, p = p_1.
ContactPoint sharpCrossing(const CurvePoint& f, const CurvePoint& g, int sign);
FeatureJacobian sharpCrossingJacobian(const CurvePoint& f, const CurvePoint& g, int sign);

/// phi = |w| - r_2, n = w/|w|, p = p_1: the second curve is swept by a ball.
ContactPoint sweptCrossing(const CurvePoint& f, const CurvePoint& g);
FeatureJacobian sweptCrossingJacobian(const CurvePoint& f, const CurvePoint& g);

}  // namespace carom::gaps
