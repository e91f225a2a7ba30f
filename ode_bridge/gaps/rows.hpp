// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "adjoint/numeric/dual.hpp"
#include "ode_bridge/gaps.hpp"

/// What the table of gaps is made of: for each kind that is not a swapped one its value and its derivative, in one
/// file. The derivative is written for any number S and made for two: double, and duals, which give its rates.
namespace carom::gaps {

using namespace adjoint_detail;
using namespace ode_bridge_detail;

/// Numbers of second derivatives, four directions at a time.
using Rate4 = Dual<4>;

/// WorldFeature of another number.
template <class S>
struct FeatureIn {
  V3<S> point, direction;
  S radius, rim, apex;
};
template <class S>
using FeatureOf = std::conditional_t<std::is_same_v<S, double>, WorldFeature, FeatureIn<S>>;

inline const WorldFeature& valueOf(const WorldFeature& f) { return f; }
inline WorldFeature valueOf(const FeatureIn<Rate4>& f) {
  return {valuesOf(f.point), valuesOf(f.direction), f.radius.value, f.rim.value, f.apex.value};
}

/// A root found with values alone, followed as its equation G(s) = 0 changes: `G` at the root with rates, and dG/ds.
inline double followed(double root, double, double) { return root; }
inline Rate4 followed(double root, const Rate4& G, const Rate4& slope) {
  Rate4 s = G.chain(root, -1 / slope.value);
  return s;
}

/// d(gap, normal, point) by (point, direction, swept radius, radius of the rim, apex) of the first feature, then of the
/// second. A direction is unit and moves across itself only.
template <class S>
using JacobianOf = Eigen::Matrix<S, 7, 18>;
using FeatureJacobian = JacobianOf<double>;

// Columns of a FeatureJacobian.
constexpr int kSide = 9;
constexpr int kP1 = 0, kD1 = 3, kR1 = 6, kRim1 = 7, kApex1 = 8;
constexpr int kP2 = 9, kD2 = 12, kR2 = 15, kRim2 = 16, kApex2 = 17;

ContactPoint pointPlane(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint pointPoint(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint pointEdge(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint edgeEdge(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimPlane(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimPoint(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimEdge(const WorldFeature& f, const WorldFeature& g, int sign);
ContactPoint rimRim(const WorldFeature& f, const WorldFeature& g, int sign);

template <class S>
JacobianOf<S> pointPlaneJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> pointPointJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> pointEdgeJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> edgeEdgeJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> rimPlaneJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> rimPointJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> rimEdgeJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);
template <class S>
JacobianOf<S> rimRimJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign);

}  // namespace carom::gaps

/// The two numbers that a derivative is made for; stands in the namespace, after its definition.
#define CAROM_GAP_JACOBIAN(name)                                                                          \
  template JacobianOf<double> name<double>(const FeatureOf<double>&, const FeatureOf<double>&, int sign); \
  template JacobianOf<Rate4> name<Rate4>(const FeatureOf<Rate4>&, const FeatureOf<Rate4>&, int sign)
