#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ode_bridge/separation.h"

// Along a direction n(t), from b to a, the separation at t + h is at least
//   min_i (c_i + c'_i h) - max_j (d_j + d'_j h) - radii - 1/2 bend h^2,
// where c_i and d_j are the vertices of a and b along n, seen from the origin of b, and `bend` bounds the sum of their
// second derivatives over the step. For every pair (i, j) this is a concave parabola that starts positive, so it stays
// positive up to its first root, and the least root over the pairs is a safe step.

namespace carom {
namespace {

constexpr int kMostVertices = 8;

struct Front {
  int count = 1;
  std::array<double, kMostVertices> at{}, rate{};

  void add(double value, double slope) {
    at[static_cast<std::size_t>(count)] = value;
    rate[static_cast<std::size_t>(count++)] = slope;
  }
};

struct Fronts {
  Front a, b;
  double radii = 0;
};

// Quantities of the pair that bound second derivatives.
struct PairBounds {
  double gravity, speed, distance, reach_a, reach_b, turn_a, turn_b;

  double relativeSpeed(double h) const { return speed + gravity * h; }
  double separationOfOrigins(double h) const { return distance + relativeSpeed(h) * h; }
};

// Acceleration of a vertex about its origin: |omega x (omega x r)| + |omega' x r|.
double turning(const Placed& p) { return p.spin * p.spin + p.spin_rate; }

// First root of c + rate h - bend h^2/2, c > 0.
double firstRoot(double c, double rate, double bend) {
  const double root = std::sqrt(rate * rate + 2 * bend * c);
  if (rate < 0) return 2 * c / (root - rate);
  return bend > 0 ? (rate + root) / bend : std::numeric_limits<double>::infinity();
}

double firstTouch(const Fronts& f, double lift, double bend, double limit) {
  double h = limit;
  for (int round = 0; round < kMostVertices * kMostVertices; ++round) {
    std::size_t i = 0, j = 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < static_cast<std::size_t>(f.a.count); ++k)
      if (const double v = f.a.at[k] + f.a.rate[k] * h; v < low) low = v, i = k;
    for (std::size_t k = 0; k < static_cast<std::size_t>(f.b.count); ++k)
      if (const double v = f.b.at[k] + f.b.rate[k] * h; v > high) high = v, j = k;
    if (low - high - f.radii + lift - 0.5 * bend * h * h >= 0) break;
    const double next = firstRoot(f.a.at[i] - f.b.at[j] - f.radii + lift, f.a.rate[i] - f.b.rate[j], bend);
    if (!(next < h)) break;
    h = next;
  }
  return h;
}

// Bounds on second derivatives grow with the window that they must hold in, and the step cannot pass the window: looks
// for the window that gives the longest step, from a first guess at the time that the separation lasts.
template <class Step>
double bestWindow(double limit, double guess, const Step& step) {
  double best = 0, window = std::min(limit, 4 * guess);
  if (!(window > 0)) window = limit;
  for (int round = 0; round < 6; ++round) {
    const double h = step(window);
    if (h <= best) break;
    best = h;
    if (h == window && window < limit)
      window = std::min(limit, 4 * window);
    else if (h < 0.5 * window)
      window = 2 * h;
    else
      break;
  }
  return best;
}

template <class Visit>
void eachVertex(const Placed& p, const Visit& visit) {
  for (const Feature& v : p.solid->vertices) visit(Vec3(p.k.R * v.point));
}

// The direction turns with b, whose vertices therefore stay where they are along it; or it stays as it is and the
// vertices of both move (balls do not: they look the same from all sides).
double stepInFrameOfB(const Placed& a, const Placed& b, const Witness& w, const Vec3& n, const PairBounds& bounds,
                      double slack, double limit) {
  const bool turns = w.frame != Witness::Frame::world && b.spin > 0 && !w.bounding;
  const Vec3 wb = turns ? b.k.w : Vec3::Zero();
  const Vec3 D = a.k.x - b.k.x, V = a.k.v - b.k.v;
  Fronts f;
  f.a.count = f.b.count = 0;
  if (w.bounding) {
    f.a.add(n.dot(D), n.dot(V));
    f.radii = a.solid->bound();
  } else {
    eachVertex(a, [&](const Vec3& r) {
      const Vec3 p = D + r;
      f.a.add(n.dot(p), n.dot(V + a.k.w.cross(r) - wb.cross(p)));
    });
    f.radii = a.solid->radius;
  }
  if (b.solid->plane) {
    f.b.add(b.solid->faces[0].point.dot(b.solid->faces[0].direction), 0);
  } else if (w.bounding) {
    f.b.add(0, 0);
    f.radii += b.solid->bound();
  } else {
    eachVertex(b, [&](const Vec3& r) { f.b.add(n.dot(r), turns ? 0 : n.dot(b.k.w.cross(r))); });
    f.radii += b.solid->radius;
  }
  const double lift = std::max(0.0, slack - w.separation);
  const double own = w.bounding ? 0 : bounds.turn_a * bounds.reach_a;
  if (!turns) {
    const double pull = n.dot(a.acceleration - b.acceleration);
    const double other = w.bounding ? 0 : bounds.turn_b * bounds.reach_b;
    return firstTouch(f, lift, std::max(0.0, own + other - pull), limit);
  }
  // in the turning frame: relative, Coriolis and centrifugal parts, each at its largest within the window
  return bestWindow(limit, (std::abs(w.separation) + slack) / (bounds.speed + a.spin * bounds.reach_a),
                    [&](double window) {
                      const double speed = bounds.relativeSpeed(window) + a.spin * bounds.reach_a;
                      const double reach = bounds.separationOfOrigins(window) + bounds.reach_a;
                      const double bend = bounds.gravity + own + 2 * b.spin * speed + bounds.turn_b * reach;
                      return firstTouch(f, lift, bend, window);
                    });
}

double stepAcrossEdges(const Placed& a, const Placed& b, const Witness& w, const PairBounds& bounds, double slack,
                       double limit) {
  const Vec3 c = w.edge_a.cross(w.edge_b), D = a.k.x - b.k.x, V = a.k.v - b.k.v;
  const double sine = c.norm(), sign = c.dot(w.n) >= 0 ? 1 : -1;
  const Vec3 dc = a.k.w.cross(w.edge_a).cross(w.edge_b) + w.edge_a.cross(b.k.w.cross(w.edge_b));
  const Vec3 dn = sign / sine * (dc - w.n * w.n.dot(dc));
  Fronts f;
  f.a.count = f.b.count = 0;
  eachVertex(a, [&](const Vec3& r) {
    const Vec3 p = D + r;
    f.a.add(w.n.dot(p), dn.dot(p) + w.n.dot(V + a.k.w.cross(r)));
  });
  eachVertex(b, [&](const Vec3& r) { f.b.add(w.n.dot(r), dn.dot(r) + w.n.dot(b.k.w.cross(r))); });
  f.radii = a.solid->radius + b.solid->radius;
  const double lift = std::max(0.0, slack - w.separation);
  // |c'| <= W, |c''| <= Z, and |c| >= sine/2 within the window, so |n'| <= W/s, |n''| <= Z/s + 3 W^2/s^2
  const double W = a.spin + b.spin, Z = W * W + a.spin_rate + b.spin_rate, s = 0.5 * sine;
  const double n1 = W / s, n2 = Z / s + 3 * n1 * n1;
  const double longest = W > 0 ? std::min(limit, s / W) : limit;
  return bestWindow(
      longest, (std::abs(w.separation) + slack) / (bounds.speed + a.spin * bounds.reach_a + b.spin * bounds.reach_b),
      [&](double window) {
        const double speed = bounds.relativeSpeed(window) + a.spin * bounds.reach_a;
        const double reach = bounds.separationOfOrigins(window) + bounds.reach_a;
        const double bend_a = n2 * reach + 2 * n1 * speed + bounds.turn_a * bounds.reach_a + bounds.gravity;
        const double bend_b = (n2 + 2 * n1 * b.spin + bounds.turn_b) * bounds.reach_b;
        return firstTouch(f, lift, bend_a + bend_b, window);
      });
}

}  // namespace

double safeStep(const Placed& a, const Placed& b, const Witness& w, double slack, double limit) {
  PairBounds bounds;
  bounds.gravity = (a.acceleration - b.acceleration).norm();
  bounds.speed = (a.k.v - b.k.v).norm();
  bounds.distance = (a.k.x - b.k.x).norm();
  bounds.reach_a = a.solid->reach;
  bounds.reach_b = b.solid->reach;
  bounds.turn_a = turning(a);
  bounds.turn_b = turning(b);
  if (w.frame == Witness::Frame::crossed) return stepAcrossEdges(a, b, w, bounds, slack, limit);
  if (w.frame != Witness::Frame::body_a) return stepInFrameOfB(a, b, w, w.n, bounds, slack, limit);
  std::swap(bounds.reach_a, bounds.reach_b);
  std::swap(bounds.turn_a, bounds.turn_b);
  return stepInFrameOfB(b, a, w, -w.n, bounds, slack, limit);
}

}  // namespace carom
