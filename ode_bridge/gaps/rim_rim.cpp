#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "ode_bridge/gaps/crossing.h"

// In the frame p = d_1 x d_2/|..| along the line of both planes, v = d x p in each plane: the points of the smaller rim
// ("moving", radius r) are C_m + r (p cos(theta) + v_m sin(theta)); the distance of one from the larger rim (radius R)
// is F(theta) = h^2 + (|a| - R)^2, h along d and a across it. Its minima are the zeros of F'/(2r) = G where G rises;
// there are two of them at most. They are bracketed by samples of G and G' and refined by Newton's method inside the
// bracket.
namespace carom::gaps {
namespace {

struct Turn {
  double c, s;  // cos and sin of theta
  explicit Turn(double theta) : c(std::cos(theta)), s(std::sin(theta)) {}
  Turn() = default;
};

struct Slope {
  double G, second;  // G and dG/dtheta
};

struct RimBeforeRim {
  const WorldFeature &moving, &still;
  Vec3 p, v_moving, v_still;
  double r, R, cosine;
  double c_p, c_v;  // C_m - C_s in the moving rim's plane
  double a_p, a_v;  // the same in the still rim's plane

  RimBeforeRim(const WorldFeature& m, const WorldFeature& s, const Vec3& along)
      : moving(m), still(s), p(along), v_moving(m.direction.cross(p)), v_still(s.direction.cross(p)) {
    r = m.rim, R = s.rim, cosine = m.direction.dot(s.direction);
    const Vec3 c = m.point - s.point;
    c_p = a_p = c.dot(p);
    c_v = c.dot(v_moving);
    a_v = c.dot(v_still);
  }

  Slope slope(const Turn& t) const {
    const double x = a_p + r * t.c, y = a_v + r * cosine * t.s;  // a
    const double dx = -t.s, dy = cosine * t.c;                   // a'/r
    const double a2 = x * x + y * y, over = 1 / std::sqrt(a2);
    const double radial = (x * dx + y * dy) * over;  // |a|'/r
    const double bend = (r * (dx * dx + dy * dy) - x * t.c - y * cosine * t.s) * over - r * radial * radial * over;
    return {c_v * t.c - c_p * t.s - R * radial, -c_v * t.s - c_p * t.c - R * bend};
  }

  // The points at theta, and how far they are along p.
  struct Place {
    CurvePoint of_moving, of_still;
    double along;
  };
  Place place(double theta) const {
    const Turn t(theta);
    const Vec3 u_moving = t.c * p + t.s * v_moving;
    const double x = a_p + r * t.c, y = a_v + r * cosine * t.s;
    const Vec3 u_still = (x * p + y * v_still) / std::hypot(x, y);
    Place at{CurvePoint::onRim(moving, u_moving), CurvePoint::onRim(still, u_still), 0};
    at.along = p.dot(at.of_moving.point + at.of_still.point);
    return at;
  }

  // The zero of G in (low, high), G(low) < 0 < G(high).
  double zero(double low, double high) const {
    double theta = 0.5 * (low + high);
    for (int i = 0; i < 100; ++i) {
      const Slope at = slope(Turn(theta));
      if (at.G == 0) break;
      (at.G < 0 ? low : high) = theta;
      double next = theta - at.G / at.second;
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      if (std::abs(next - theta) <= 1e-16 * std::max(1.0, std::abs(theta))) break;
      theta = next;
    }
    return theta;
  }

  // Where between low and high, at both of which G has one sign, G is extreme; `end` is that of G' at low. Stops early
  // where G has the other sign.
  double extreme(double low, double high, double sign, double end) const {
    for (int i = 0; i < 24; ++i) {
      const double theta = 0.5 * (low + high);
      const Slope at = slope(Turn(theta));
      if (!(at.G * sign > 0)) return theta;
      (at.second * end > 0 ? low : high) = theta;
    }
    return 0.5 * (low + high);
  }
};

constexpr int kSamples = 32;

double angle(int i) { return 2 * std::numbers::pi / kSamples * i; }

const std::array<Turn, kSamples>& turns() {
  static const std::array<Turn, kSamples> all = [] {
    std::array<Turn, kSamples> made;
    for (int i = 0; i < kSamples; ++i) made[static_cast<std::size_t>(i)] = Turn(angle(i));
    return made;
  }();
  return all;
}

struct Minima {
  int count = 0;
  std::array<double, 2> theta{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  void add(double at) {
    if (count < 2) theta[static_cast<std::size_t>(count++)] = at;
  }
};

Minima minimaOf(const RimBeforeRim& rims) {
  const auto& sample = turns();
  Minima found;
  const Slope start = rims.slope(sample[0]);
  Slope left = start;
  for (int i = 0; i < kSamples; ++i) {
    const Slope right = i + 1 < kSamples ? rims.slope(sample[static_cast<std::size_t>(i + 1)]) : start;
    const double low = angle(i), high = angle(i + 1);
    if (left.G < 0 && right.G >= 0) {
      found.add(right.G > 0 ? rims.zero(low, high) : high);
    } else if (left.G > 0 && right.G > 0 && left.second < 0 && right.second > 0) {
      const double dip = rims.extreme(low, high, 1, -1);
      if (rims.slope(Turn(dip)).G < 0) found.add(rims.zero(dip, high));
    } else if (left.G < 0 && right.G < 0 && left.second > 0 && right.second < 0) {
      const double bump = rims.extreme(low, high, -1, 1);
      if (rims.slope(Turn(bump)).G > 0) found.add(rims.zero(low, bump));
    }
    left = right;
  }
  return found;
}

struct Crossing {
  CurvePoint of_first, of_second;
};

Crossing nearest(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Vec3 c = f.direction.cross(g.direction);
  const Vec3 along = c / c.norm();
  const bool first_moves = f.rim < g.rim;
  const RimBeforeRim rims(first_moves ? f : g, first_moves ? g : f, along);
  const Minima minima = minimaOf(rims);
  RimBeforeRim::Place at = rims.place(minima.theta[0]);
  if (minima.count == 2) {
    const RimBeforeRim::Place other = rims.place(minima.theta[1]);
    if ((std::abs(sign) == 2) == (other.along > at.along)) at = other;
  }
  if (first_moves) return {at.of_moving, at.of_still};
  return {at.of_still, at.of_moving};
}

}  // namespace

ContactPoint rimRim(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Crossing c = nearest(f, g, sign);
  return sharpCrossing(c.of_first, c.of_second, sign);
}

FeatureJacobian rimRimJacobian(const WorldFeature& f, const WorldFeature& g, int sign) {
  const Crossing c = nearest(f, g, sign);
  return sharpCrossingJacobian(c.of_first, c.of_second, sign);
}

}  // namespace carom::gaps
