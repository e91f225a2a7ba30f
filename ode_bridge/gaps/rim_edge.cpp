// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdlib>

#include "adjoint/numeric/elementary.hpp"
#include "ode_bridge/gaps/crossing.hpp"
#include "ode_bridge/gaps/tapered.hpp"

// The line of the edge is X(s) = C + q + s e, q its foot of the perpendicular from C. The distance of X from the rim,
// F(s) = h^2 + (|a| - rho)^2 with h along d and a across it, has the slope
//   F'/2 = G(s) = s - rho y/|a|,  y = a.a' = q_a.e_a + kappa^2 s,  |a|^2 = k^2 + (y/kappa)^2,  kappa = |e_a|.
// Its second derivative G' = 1 - rho kappa^2 k^2/|a|^3 grows with |y|, so F has at most two minima, one on each side of
// y = 0, where G is concave before and convex after it: Newton's steps from outside never step over them.
namespace carom::gaps {
namespace {

template <class S>
struct LineBeforeRim {
  V3<S> q_across, e_across;
  S base;         // s of the foot of the perpendicular from C, from the edge's point
  S rho, kappa2;  // kappa^2
  S y0, k2;       // y at s = 0; k^2

  LineBeforeRim(const FeatureOf<S>& f, const FeatureOf<S>& g) {
    const V3<S>&d = f.direction, &e = g.direction, to = g.point - f.point;
    base = -e.dot(to);
    const V3<S> q = to + base * e;
    q_across = q - d.dot(q) * d;
    e_across = e - d.dot(e) * d;
    rho = f.rim;
    kappa2 = e_across.squaredNorm();
    y0 = q_across.dot(e_across);
    const S area = d.dot(q_across.cross(e_across));
    k2 = kappa2 > 0 ? S(area * area / kappa2) : q_across.squaredNorm();
  }

  S slope(double s, S& second) const {
    using std::sqrt;
    const S y = y0 + kappa2 * s, a2 = k2 + (kappa2 > 0 ? S(y * y / kappa2) : S(0)), a = sqrt(a2);
    second = 1 - rho * kappa2 * k2 / (a2 * a);
    return s - rho * y / a;
  }
};

// Newton from `s`, outside of a minimum and on the side of `side`, inwards.
double minimumFrom(const LineBeforeRim<double>& line, double s, double side) {
  for (int i = 0; i < 80; ++i) {
    double second;
    const double G = line.slope(s, second);
    const double next = s - G / second;
    if (!(G * side > 0 && second > 0) || !((s - next) * side > 0)) break;
    s = next;
  }
  return s;
}

// The first or the second minimum of F, the same where there is one. G falls between middle -+ half, where its values
// are middle +- (drop - half).
double minimum(const LineBeforeRim<double>& line, int branch) {
  const double kappa2 = line.kappa2, k2 = line.k2, rho = line.rho;
  if (kappa2 == 0) return 0;
  const double kappa = std::sqrt(kappa2), k = std::sqrt(k2), outside = rho * kappa, middle = -line.y0 / kappa2;
  double half = 0, drop = 0;
  if (rho * kappa2 > k) {
    const double a = elementary::cbrt(rho * kappa2 * k2);
    half = std::sqrt(std::max(0.0, a * a - k2)) / kappa;
    drop = a > 0 ? rho * kappa2 * half / a : outside;
  }
  const bool before = middle + drop - half > 0, after = !before || middle - drop + half <= 0;
  return before && (branch == 1 || !after) ? minimumFrom(line, -outside, -1) : minimumFrom(line, outside, 1);
}

template <class S>
struct Crossing {
  CurvePoint<S> of_rim, of_edge;
};

template <class S>
Crossing<S> nearest(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  const LineBeforeRim<S> line(f, g);
  const double root = minimum(LineBeforeRim<double>(valueOf(f), valueOf(g)), branchOf(sign));
  S second;
  const S G = line.slope(root, second), s = followed(root, G, second);
  const V3<S> a = line.q_across + s * line.e_across;
  return {CurvePoint<S>::onRim(f, a / a.norm()), CurvePoint<S>::onEdge(g, line.base + s)};
}

}  // namespace

ContactPoint rimEdge(const WorldFeature& f, const WorldFeature& g, int sign) {
  if (g.apex > 0) return rimTapered(f, g, sign);
  const Crossing<double> c = nearest<double>(f, g, sign);
  const bool by_distance = g.radius > 0 || isApart(sign);
  return by_distance ? sweptCrossing(c.of_rim, c.of_edge) : sharpCrossing(c.of_rim, c.of_edge, sign);
}

template <class S>
JacobianOf<S> rimEdgeJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  if (g.apex > 0) return rimTaperedJacobian<S>(f, g, sign);
  const Crossing<S> c = nearest<S>(f, g, sign);
  const bool by_distance = g.radius > 0 || isApart(sign);
  return by_distance ? sweptCrossingJacobian(c.of_rim, c.of_edge) : sharpCrossingJacobian(c.of_rim, c.of_edge, sign);
}
CAROM_GAP_JACOBIAN(rimEdgeJacobian);

}  // namespace carom::gaps
