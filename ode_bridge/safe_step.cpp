// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "ode_bridge/separation.hpp"
#include "ode_bridge/time_to.hpp"

// Along a direction n(t), from b to a, the separation at t + h is at least
//   g(h) = c + c' h + min_A (n + m_A h).r - max_B (n + m_B h).r - 1/2 bend h^2,
// r over the points of a core seen from its body's origin: every point is followed to first order, and `bend` bounds
// the second derivatives over the step. Each of the three parts is concave in h (a least of linear functions, less a
// greatest, less a parabola), so where g starts positive it stays positive up to its first root.

namespace carom::ode_bridge_detail {

namespace {

// g(h), and the parabola through the points that decide it at h, which lies above g.
struct Front {
  double at = 0, rate = 0;  ///< g = at + rate h - 1/2 bend h^2 for the points that decide
};

// The moving points of one side: a core in the body's axes, and (n + m h) there; or nothing for a half space.
struct Side {
  const Solid* solid = nullptr;
  const Piece* piece = nullptr;  ///< without it the single point `center`
  Vec3 center = Vec3::Zero();
  Vec3 n = Vec3::Zero(), m = Vec3::Zero();

  // the point that lies least (toward -1) or furthest (+1) along n + m h
  void add(double h, double toward, Front& front) const {
    if (!solid) return;
    const Vec3 p = piece ? supportOf(*solid, *piece, toward * (n + h * m)).at : center;
    front.at -= toward * n.dot(p);
    front.rate -= toward * m.dot(p);
  }
};

struct Gap {
  double at = 0, rate = 0;
  Side a, b;

  Front front(double h) const {
    Front f{at, rate};
    a.add(h, -1, f);
    b.add(h, 1, f);
    return f;
  }
};

// First root of c + rate h - bend h^2/2, c > 0.
double firstRoot(double c, double rate, double bend) { return timeTo(c, -rate, bend); }

constexpr int kMostStepRounds = 40;

// A time up to which g stays positive, at most `limit`: nearly its first root. Every parabola lies above g, so their
// roots come down to that of g; should they not reach it, the chord from g(0) ends before it.
double firstTouch(const Gap& gap, double bend, double limit) {
  const Front start = gap.front(0);
  if (!(start.at > 0)) return 0;
  double h = std::min(limit, firstRoot(start.at, start.rate, bend)), value = 0;
  for (int round = 0; round < kMostStepRounds; ++round) {
    const Front f = gap.front(h);
    value = f.at + f.rate * h - 0.5 * bend * h * h;
    if (value >= 0) return h;
    const double next = firstRoot(f.at, f.rate, bend);
    if (!(next < h)) break;
    h = next;
    if (round == kMostStepRounds - 1) {
      const Front last = gap.front(h);
      value = last.at + last.rate * h - 0.5 * bend * h * h;
      if (value >= 0) return h;
    }
  }
  return h * (start.at / (start.at - value));
}

// Bounds on second derivatives grow with the window that they must hold in, and the step cannot pass the window: looks
// for the window that gives the longest step, from a first guess at the time that the separation lasts.
template <class Step>
double bestWindow(double limit, double guess, const Step& step) {
  double best = 0, window = std::min(limit, 4 * guess);
  if (!(window > 0)) window = limit;
  for (int round = 0; round < 6;) {
    const double h = step(window);
    if (h <= best) break;
    best = h;
    if (h == window && window < limit) {
      window = std::min(limit, 8 * window);  // nothing is near yet
    } else if (h < 0.5 * window) {
      window = 2 * h;
      ++round;
    } else {
      break;
    }
  }
  return best;
}

// The axis of a piece that looks the same however far it is turned about it, through its body's origin; solid's axes.
std::optional<Vec3> axisOfRevolution(const PlacedPiece& p) {
  const Piece& piece = *p.piece;
  Vec3 axis = piece.axis;
  if (piece.core == Piece::Core::segment) {
    const Vec3* points = p.solid().points.data() + piece.points.first;
    axis = (points[1] - points[0]).normalized();
  } else if (piece.core != Piece::Core::frustum) {
    return std::nullopt;
  }
  if (!piece.center.cross(axis).isZero(0)) return std::nullopt;
  return axis;
}

// One side of a pair, as the bounds see it. Its points turn with the body; those of a body of revolution may as well
// turn with its axis alone, without spinning about it, which sweeps the same solid.
struct Mover {
  const Placed* body;
  const Piece* piece;  ///< or the single point `center`
  Vec3 center;
  double radius;  ///< furthest point of the core from the body's origin, m
  bool half_space;
  Vec3 w = Vec3::Zero();           ///< angular velocity of the points, world axes
  double spin = 0, spin_rate = 0;  ///< bounds on it and its rate over the flight

  explicit Mover(const PlacedPiece& p)
      : body(p.body), piece(p.piece), center(p.piece->center), radius(p.coreRadius()), half_space(p.halfSpace()) {
    turnWithBody();
    if (!(spin > 0) || !body->arc) return;
    if (const auto axis = axisOfRevolution(p)) turnWithAxis(*axis);
  }
  explicit Mover(const PlacedNode& p)
      : body(p.body), piece(nullptr), center(p.node->center), radius(center.norm()), half_space(p.body->solid->plane) {
    turnWithBody();
  }

  /// |d2r/dt2| of a point at distance 1 is at most |w x (w x r)| + |w' x r|.
  double turning() const { return spin * spin + spin_rate; }
  /// |n x w| now; 0 where n is the direction of w but for rounding: turning about it moves nothing along n by more than
  /// twice that share of its distance, however fast.
  double acrossSpin(const Vec3& n) const {
    const double across = n.cross(w).norm(), rounding = kSpinRounding * spin;
    return across > rounding ? std::min(spin, across + rounding) : 0;
  }
  /// Bound on it over a window in which |dn/dt| <= turn, from its value `across` at the start.
  double acrossSpin(double across, double turn, double window) const {
    const double drift = turn * spin + spin_rate;
    return drift > 0 ? std::min(spin, across + drift * window) : across;
  }
  /// Bound on |n . d2r/dt2| for points r of the core over such a window: with n x w and w x r in
  /// n . (w x (w x r)) = (n x w) . (w x r), what spins about n itself does not count.
  double bendAlong(double across, double turn, double window) const {
    if (half_space || radius == 0) return 0;
    return (acrossSpin(across, turn, window) * spin + spin_rate) * radius;
  }
  /// The same with all of its body's spin.
  Mover withBody() const {
    Mover m = *this;
    m.turnWithBody();
    return m;
  }

  Side side(const Vec3& n, const Vec3& m) const {
    if (half_space) return {};
    const Mat3& R = body->k.R;
    return {body->solid, piece, center, R.transpose() * n, R.transpose() * m};
  }

 private:
  static constexpr double kSpinRounding = 1e-15;

  void turnWithBody() {
    spin = body->spin, spin_rate = body->spin_rate;
    if (spin > 0) w = body->k.w;
  }
  // The axis precesses steadily, da/dt = p x a, so that of w = a x da/dt both |w| and |dw/dt| = |p x w| are bounded.
  void turnWithAxis(const Vec3& axis) {
    const auto steady = body->arc->steadyAxis();
    if (!steady || (!steady->isZero(0) && !steady->cross(axis).isZero(kSpinRounding))) return;
    const Vec3 a = body->k.R * axis;
    w -= a * a.dot(w);
    spin = w.norm() + 4 * kSpinRounding * body->spin;
    spin_rate = body->arc->precession() * spin;
  }
};

double variationOf(const Mover& a, const Mover& b) { return a.body->variation + b.body->variation; }
// Bound on the acceleration against each other.
double gravityOf(const Mover& a, const Mover& b) {
  return (a.body->acceleration - b.body->acceleration).norm() + variationOf(a, b);
}
Vec3 apart(const Mover& a, const Mover& b) { return a.body->k.x - b.body->k.x; }
Vec3 velocity(const Mover& a, const Mover& b) { return a.body->k.v - b.body->k.v; }

// The level of a half space along its normal, seen from the origin of its body.
double levelOf(const Mover& plane) {
  const SolidFace& face = plane.body->solid->faces[0];
  return face.point.dot(face.direction);
}

// The direction stays as it is. `lift` is what is added to the separation, radii counted.
double stepInWorld(const Mover& a, const Mover& b, const Vec3& n, double lift, double limit) {
  Gap gap;
  gap.at = n.dot(apart(a, b)) + lift - (b.half_space ? levelOf(b) : 0);
  gap.rate = n.dot(velocity(a, b));
  gap.a = a.side(n, n.cross(a.w));
  gap.b = b.side(n, n.cross(b.w));
  const double pull = n.dot(a.body->acceleration - b.body->acceleration) - variationOf(a, b);
  const double across_a = a.acrossSpin(n), across_b = b.half_space ? 0 : b.acrossSpin(n);
  const auto step = [&](double window) {
    const double bend = a.bendAlong(across_a, 0, window) + b.bendAlong(across_b, 0, window) - pull;
    return firstTouch(gap, std::max(0.0, bend), window);
  };
  // a bound that grows with the window is worth a shorter one where the direction is nearly that of the spin
  const auto grows = [](const Mover& m, double across) { return m.spin_rate > 0 && across < 0.25 * m.spin; };
  if (!grows(a, across_a) && !grows(b, across_b)) return step(limit);
  const double room = gap.front(0).at, speed = std::abs(gap.rate) + a.spin * a.radius + b.spin * b.radius;
  return bestWindow(limit, room / speed, step);
}

// The direction turns with b, whose points therefore stay where they are along it. `room` is the separation, to guess
// a window by.
double stepInFrameOfB(const Mover& a, const Mover& b, const Vec3& n, double room, double lift, double limit) {
  if (!(b.spin > 0)) return stepInWorld(a, b, n, lift, limit);
  const Vec3 wb = b.body->k.w, D = apart(a, b), V = velocity(a, b);
  Gap gap;
  gap.at = n.dot(D) + lift - (b.half_space ? levelOf(b) : 0);
  gap.rate = n.dot(V - wb.cross(D));
  gap.a = a.side(n, n.cross(a.w - wb));
  gap.b = b.side(n, Vec3::Zero());
  const double gravity = gravityOf(a, b), speed = V.norm(), distance = D.norm();
  const double spin = b.body->spin, spin_rate = b.body->spin_rate;
  const Mover frame = b.withBody();
  const double across_frame = frame.acrossSpin(n), across_a = a.acrossSpin(n);
  // relative, Coriolis and centrifugal parts, each at its largest within the window; n turns at |w_b x n|, which only a
  // change of w_b changes
  return bestWindow(limit, room / (speed + a.spin * a.radius), [&](double window) {
    const double turn = frame.acrossSpin(across_frame, 0, window);
    const double fastest = speed + gravity * window + a.spin * a.radius;
    const double furthest = distance + (speed + gravity * window) * window + a.radius;
    const double frame_bend = 2 * turn * fastest + (turn * spin + spin_rate) * furthest;
    const double bend = gravity + a.bendAlong(across_a, turn, window) + frame_bend;
    return firstTouch(gap, bend, window);
  });
}

// A direction that turns with both bodies: its rate now, and bounds on its derivatives over a window.
struct TurningNormal {
  Vec3 rate;
  double first = 0, second = 0, longest = 0;
};

// n along c = edge_a x edge_b.
TurningNormal acrossEdges(const Mover& a, const Mover& b, const Witness& w, double limit) {
  const Vec3 c = w.edge_a.cross(w.edge_b);
  const double sine = c.norm(), sign = c.dot(w.n) >= 0 ? 1 : -1;
  const Vec3 dc = a.w.cross(w.edge_a).cross(w.edge_b) + w.edge_a.cross(b.w.cross(w.edge_b));
  // |c'| <= W, |c''| <= Z, and |c| >= sine/2 within the window, so |n'| <= W/s, |n''| <= Z/s + 3 W^2/s^2
  const double W = a.spin + b.spin, Z = W * W + a.spin_rate + b.spin_rate, s = 0.5 * sine, n1 = W / s;
  return {sign / sine * (dc - w.n * w.n.dot(dc)), n1, Z / s + 3 * n1 * n1, W > 0 ? std::min(limit, s / W) : limit};
}

// n keeps its angles to both axes, so that seen from b it turns about edge_b at the rate p:
//   p D = -n . d',  D = (edge_b x n) . edge_a,  d' the rate of edge_a seen from b.
TurningNormal betweenTapered(const Mover& a, const Mover& b, const Witness& w, double limit) {
  const Vec3 about = w.edge_b.cross(w.n);
  const double D = about.dot(w.edge_a), s = 0.5 * std::abs(D);
  if (!(s > 1e-9)) return {Vec3::Zero()};  // hardly decided by the axes
  const double now = -w.n.dot((a.w - b.w).cross(w.edge_a)) / D;
  // |d'| <= W, |d''| <= Z and |D'| <= p + W; |D| >= s within the window
  const double W = a.spin + b.spin, Z = W * W + a.spin_rate + b.spin_rate + a.spin * b.spin, p = W / s;
  const double dp = (p * (p + W) + p * W + Z) / s;
  return {b.w.cross(w.n) + now * about, b.spin + p, dp + p * p + 2 * b.spin * p + b.turning(),
          W > 0 ? std::min(limit, s / (p + W)) : limit};
}

double stepWithNormal(const Mover& a, const Mover& b, const Vec3& n, const TurningNormal& turning, double room,
                      double lift) {
  if (!(turning.longest > 0)) return 0;
  const Vec3 D = apart(a, b), V = velocity(a, b), dn = turning.rate;
  Gap gap;
  gap.at = n.dot(D) + lift;
  gap.rate = dn.dot(D) + n.dot(V);
  gap.a = a.side(n, dn + n.cross(a.w));
  gap.b = b.side(n, dn + n.cross(b.w));
  const double n1 = turning.first, n2 = turning.second, longest = turning.longest;
  const double gravity = gravityOf(a, b), speed = V.norm(), distance = D.norm();
  return bestWindow(longest, room / (speed + a.spin * a.radius + b.spin * b.radius), [&](double window) {
    const double fastest = speed + gravity * window + a.spin * a.radius;
    const double furthest = distance + (speed + gravity * window) * window + a.radius;
    const double bend_a = n2 * furthest + 2 * n1 * fastest + a.turning() * a.radius + gravity;
    const double bend_b = (n2 + 2 * n1 * b.spin + b.turning()) * b.radius;
    return firstTouch(gap, bend_a + bend_b, window);
  });
}

}  // namespace

double safeStep(const PlacedPiece& a, const PlacedPiece& b, const Witness& w, double slack, double limit) {
  const Mover ma(a), mb(b);
  const double room = std::max(slack, w.separation);
  const double lift = room - w.separation - a.piece->radius - b.piece->radius;
  switch (w.frame) {
    case Witness::Frame::world:
      return stepInWorld(ma, mb, w.n, lift, limit);
    case Witness::Frame::body_b:
      return stepInFrameOfB(ma, mb, w.n, room, lift, limit);
    case Witness::Frame::body_a:
      return stepInFrameOfB(mb, ma, -w.n, room, lift, limit);
    case Witness::Frame::crossed:
      // nearly parallel edges turn their common normal fast: the direction as it is may serve longer
      return std::max(stepWithNormal(ma, mb, w.n, acrossEdges(ma, mb, w, limit), room, lift),
                      stepInWorld(ma, mb, w.n, lift, limit));
    case Witness::Frame::tapered:
      return std::max(stepWithNormal(ma, mb, w.n, betweenTapered(ma, mb, w, limit), room, lift),
                      stepInWorld(ma, mb, w.n, lift, limit));
  }
  return 0;
}

Piece ballOf(const Node& node) {
  Piece ball;
  ball.core = Piece::Core::point;
  ball.center = node.center;
  ball.radius = node.radius;
  return ball;
}

double separationOf(const PlacedNode& a, const PlacedNode& b) {
  if (a.body->solid->plane) return separationOf(b, a);
  const Vec3 center = a.body->k.x + a.arm();
  if (!b.body->solid->plane) return (center - b.body->k.x - b.arm()).norm() - a.node->radius - b.node->radius;
  const SolidFace& face = b.body->solid->faces[0];
  return (b.body->k.R * face.direction).dot(center - b.body->k.x) - face.point.dot(face.direction) - a.node->radius;
}

double safeStep(const PlacedNode& a, const PlacedNode& b, double separation, double limit) {
  if (a.body->solid->plane) return safeStep(b, a, separation, limit);
  const Mover ma(a), mb(b);
  if (mb.half_space)
    return stepInFrameOfB(ma, mb, b.body->k.R * b.body->solid->faces[0].direction, separation, -a.node->radius, limit);
  const Vec3 between = a.body->k.x + a.arm() - b.body->k.x - b.arm();
  return stepInWorld(ma, mb, between / between.norm(), -a.node->radius - b.node->radius, limit);
}

}  // namespace carom::ode_bridge_detail
