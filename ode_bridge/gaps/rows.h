#pragma once

#include "ode_bridge/gaps.h"

/// What the table of gaps is made of: for each kind that is not a swapped one its value and its derivative, in one
/// file.
namespace carom::gaps {

/// d(gap, normal, point) by (point, direction, swept radius, radius of the rim) of the first feature, then of the
/// second. A direction is unit and moves across itself only.
using FeatureJacobian = Eigen::Matrix<double, 7, 16>;

// Columns of a FeatureJacobian.
constexpr int kSide = 8;
constexpr int kP1 = 0, kD1 = 3, kR1 = 6, kRim1 = 7;
constexpr int kP2 = 8, kD2 = 11, kR2 = 14, kRim2 = 15;

ContactPoint pointPlane(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint pointPoint(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint pointEdge(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint edgeEdge(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimPlane(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimPoint(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimEdge(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimRim(const WorldFeature& f, const WorldFeature& g, int sign);

FeatureJacobian pointPlaneJacobian(const WorldFeature& f, const WorldFeature& g, int sign);
FeatureJacobian pointPointJacobian(const WorldFeature& f, const WorldFeature& g, int sign);
FeatureJacobian pointEdgeJacobian(const WorldFeature& f, const WorldFeature& g, int sign);
FeatureJacobian edgeEdgeJacobian(const WorldFeature& f, const WorldFeature& g, int sign);
FeatureJacobian rimPlaneJacobian(const WorldFeature& f, const WorldFeature& g, int sign);
FeatureJacobian rimPointJacobian(const WorldFeature& f, const WorldFeature& g, int sign);
FeatureJacobian rimEdgeJacobian(const WorldFeature& f, const WorldFeature& g, int sign);
FeatureJacobian rimRimJacobian(const WorldFeature& f, const WorldFeature& g, int sign);

}  // namespace carom::gaps
