// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "adjoint/numeric/elementary.hpp"
#include "ode_bridge/gaps/crossing.hpp"
#include "ode_bridge/gaps/turns.hpp"

// With p and v = d x p in the plane of each rim, the points of the smaller one ("moving", radius r) are
// C_m + r (p_m cos(theta) + v_m sin(theta)); the distance of one from the larger rim (radius R) is
// F(theta) = h^2 + (|a| - R)^2, h along d and a across it. Its minima are the zeros of F'/(2r) = G where G rises; there
// are two of them at most. They are bracketed by samples of G and G' and refined by Newton's method inside the bracket.
// In both planes p = d_1 x d_2/|..|, along the line that they share; where they are nearly parallel, p points in each
// from the still centre to the moving one.
namespace carom::gaps {
namespace {

double hypotenuse(double x, double y) { return elementary::hypot(x, y); }
Rate4 hypotenuse(const Rate4& x, const Rate4& y) { return sqrt(x * x + y * y); }

template <class S>
struct RimBeforeRim {
  const FeatureOf<S>&moving, &still;
  V3<S> p_moving, p_still, v_moving, v_still;
  V3<S> order;  // places are told apart by how far they are along this
  S r, R;
  S pp, pv, vp, vv;  // p_still.p_moving, p_still.v_moving, v_still.p_moving, v_still.v_moving
  S c_p, c_v;        // C_m - C_s in the moving rim's plane
  S a_p, a_v;        // the same in the still rim's plane

  RimBeforeRim(const FeatureOf<S>& m, const FeatureOf<S>& s, bool first_moves, bool nearly_parallel)
      : moving(m), still(s) {
    r = m.rim, R = s.rim;
    const V3<S> c = m.point - s.point;
    if (nearly_parallel) {
      p_moving = inPlane(c, m.direction), p_still = inPlane(c, s.direction);
    } else {
      p_moving = p_still = first_moves ? alongBoth(m, s) : alongBoth(s, m);
    }
    v_moving = m.direction.cross(p_moving), v_still = s.direction.cross(p_still);
    if (nearly_parallel) {
      pp = p_still.dot(p_moving), pv = p_still.dot(v_moving), vp = v_still.dot(p_moving), vv = v_still.dot(v_moving);
      order = v_still;
    } else {
      pp = 1, pv = 0, vp = 0, vv = m.direction.dot(s.direction);
      order = p_still;
    }
    c_p = c.dot(p_moving);
    a_p = c.dot(p_still);
    c_v = c.dot(v_moving);
    a_v = c.dot(v_still);
  }
  static V3<S> inPlane(const V3<S>& c, const V3<S>& d) {
    const V3<S> across = c - d.dot(c) * d;
    return across / across.norm();
  }
  static V3<S> alongBoth(const FeatureOf<S>& f, const FeatureOf<S>& g) {
    const V3<S> c = f.direction.cross(g.direction);
    return c / c.norm();
  }

  Slope<S> slope(const Turn<double>& t) const {
    using std::sqrt;
    const S along = pp * t.c + pv * t.s, across = vp * t.c + vv * t.s;
    const S x = a_p + r * along, y = a_v + r * across;          // a
    const S dx = pv * t.c - pp * t.s, dy = vv * t.c - vp * t.s;  // a'/r
    const S a2 = x * x + y * y, over = 1 / sqrt(a2);
    const S radial = (x * dx + y * dy) * over;  // |a|'/r
    const S bend = (r * (dx * dx + dy * dy) - x * along - y * across) * over - r * radial * radial * over;
    return {c_v * t.c - c_p * t.s - R * radial, -c_v * t.s - c_p * t.c - R * bend};
  }

  // The points at theta, and how far they are along `order`.
  struct Place {
    CurvePoint<S> of_moving, of_still;
    S along;
  };
  Place place(const S& theta) const {
    const Turn<S> t(theta);
    const V3<S> u_moving = t.c * p_moving + t.s * v_moving;
    const S x = a_p + r * (pp * t.c + pv * t.s), y = a_v + r * (vp * t.c + vv * t.s);
    const V3<S> u_still = (x * p_still + y * v_still) / hypotenuse(x, y);
    Place at{CurvePoint<S>::onRim(moving, u_moving), CurvePoint<S>::onRim(still, u_still), 0};
    at.along = order.dot(at.of_moving.point + at.of_still.point);
    return at;
  }
};

// Whether the line that the planes share says less than the one between the centres: rounding of the first grows with
// 1/sine, that of the second with 1/(their distance across the axes).
bool nearlyParallel(const WorldFeature& f, const WorldFeature& g) {
  const double sine2 = f.direction.cross(g.direction).squaredNorm();
  if (!(sine2 < 1e-4)) return false;
  const double across2 = f.direction.cross(f.point - g.point).squaredNorm(), size = std::max(f.rim, g.rim);
  return across2 > sine2 * size * size;
}

// theta of the place that `sign` picks.
double chosenTheta(const RimBeforeRim<double>& rims, int sign) {
  const Minima minima = minimaOf(rims);
  if (minima.count < 2) return minima.theta[0];
  const bool second_is_further = rims.place(minima.theta[1]).along > rims.place(minima.theta[0]).along;
  return (branchOf(sign) == 2) == second_is_further ? minima.theta[1] : minima.theta[0];
}

template <class S>
struct RimCrossing {
  CurvePoint<S> of_first, of_second;
};

template <class S>
RimCrossing<S> nearestOnRims(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  const bool first_moves = f.rim < g.rim;
  const FeatureOf<S>&moving = first_moves ? f : g, &still = first_moves ? g : f;
  const WorldFeature &moving_now = valueOf(moving), &still_now = valueOf(still);
  const bool parallel = nearlyParallel(still_now, moving_now);
  const RimBeforeRim<S> rims(moving, still, first_moves, parallel);
  const double theta = chosenTheta(RimBeforeRim<double>(moving_now, still_now, first_moves, parallel), sign);
  const Slope<S> slope = rims.slope(Turn<double>(theta));
  const auto at = rims.place(followed(theta, slope.G, slope.second));
  if (first_moves) return {at.of_moving, at.of_still};
  return {at.of_still, at.of_moving};
}

}  // namespace

ContactPoint rimRim(const WorldFeature& f, const WorldFeature& g, int sign) {
  const RimCrossing<double> c = nearestOnRims<double>(f, g, sign);
  return isApart(sign) ? sweptCrossing(c.of_first, c.of_second) : sharpCrossing(c.of_first, c.of_second, sign);
}

template <class S>
JacobianOf<S> rimRimJacobian(const FeatureOf<S>& f, const FeatureOf<S>& g, int sign) {
  const RimCrossing<S> c = nearestOnRims<S>(f, g, sign);
  return isApart(sign) ? sweptCrossingJacobian(c.of_first, c.of_second)
                       : sharpCrossingJacobian(c.of_first, c.of_second, sign);
}
CAROM_GAP_JACOBIAN(rimRimJacobian);

}  // namespace carom::gaps
