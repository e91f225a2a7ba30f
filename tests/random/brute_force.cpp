// SPDX-License-Identifier: MIT
#include "tests/random/brute_force.h"

#include <algorithm>
#include <cmath>

namespace carom::brute {
namespace {

constexpr Real kAmple = 0.02L;      // m between bounding balls: no need to look at the shapes
constexpr Real kNear = 1e-4L;       // m, below which it pays to let the separating direction turn
constexpr Real kMoment = 1e-9L;     // s
constexpr Real kRounding = 1e-17L;  // m, above the rounding of separations in long double

// Position of one corner along a direction n that turns at the rate dn, to first order.
struct Line {
  Real position, rate;
};

std::vector<Line> linesOf(const Solid& solid, const Kinematic& k, const Vector& origin, const Vector& n,
                          const Vector& dn) {
  std::vector<Line> lines;
  for (const Vector& r : corners(solid, k.R)) {
    const Vector p = k.x + r - origin;
    lines.push_back({n.dot(p), n.dot(k.v + k.w.cross(r)) + dn.dot(p)});
  }
  return lines;
}

// Bound on the second derivative of a corner's position beside gravity.
Real cornerAcceleration(const Solid& solid, const Flight& flight) {
  return (flight.spinBound() * flight.spinBound() + flight.spinRateBound()) * solid.reach();
}

}  // namespace

BruteForce::BruteForce(const Scene& scene) : gravity_(widen(scene.gravity)) {
  for (const Body& b : scene.bodies) {
    BruteBody body{solidOf(b.shape), massOf(b), {}};
    const Rotation q = b.orientation.cast<Real>();
    if (b.fixed) {
      body.flight = Flight::fixedAt(widen(b.position), q);
    } else {
      const Matrix R = q.normalized().toRotationMatrix();
      const Vector L = R * body.mass.inertia.asDiagonal() * R.transpose() * widen(b.angular_velocity);
      body.flight = Flight(body.mass, gravity_, 0, widen(b.position), q, widen(b.velocity), L);
    }
    bodies_.push_back(std::move(body));
  }
  const int n = static_cast<int>(bodies_.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (mass(a).moving || mass(b).moving) {
        Pair p{};
        p.a = a, p.b = b;
        pairs_.push_back(p);
      }
}

BruteForce::Pair& BruteForce::pair(int a, int b) {
  return *std::find_if(pairs_.begin(), pairs_.end(),
                       [&](const Pair& p) { return p.a == std::min(a, b) && p.b == std::max(a, b); });
}

void BruteForce::restart(int body, Real t, const State& state) {
  BruteBody& moved = body_(body);
  moved.flight = Flight(moved.mass, gravity_, t, widen(state.x), state.q.cast<Real>(), widen(state.v), widen(state.L));
  for (Pair& p : pairs_)
    if (p.a == body || p.b == body) {
      const Pair fresh{p.a, p.b, t, t, 0, false, false, {}};
      p = fresh;
    }
}

void BruteForce::leaveContact(int a, int b, Real t) { pair(a, b).slack = 2 * std::abs(separationAt(a, b, t).value); }

bool BruteForce::hasParted(int a, int b) { return pair(a, b).apart; }

void BruteForce::lookUntil(Real t) {
  for (Pair& p : pairs_) look(p, t);
}

std::optional<Real> BruteForce::lookAt(int a, int b, Real t) {
  Pair& p = pair(a, b);
  look(p, t);
  return p.touch;
}

std::vector<BruteForce::Touch> BruteForce::touches() const {
  std::vector<Touch> list;
  for (const Pair& p : pairs_)
    if (p.touch) list.push_back({p.a, p.b, *p.touch});
  return list;
}

Separation BruteForce::separationAt(int a, int b, Real t) {
  const Kinematic ka = stateAt(a, t), kb = stateAt(b, t);
  return separation(solid(a), {ka.x, ka.R}, solid(b), {kb.x, kb.R});
}

void BruteForce::look(Pair& p, Real until) {
  while (!p.touch && p.next <= until) sample(p, p.next);
}

void BruteForce::sample(Pair& p, Real t) {
  ++samples_;
  const auto far = farApart(p, t);
  const Separation s = far ? *far : separationAt(p.a, p.b, t);
  const Real slack = std::max(p.slack, kRounding);
  if (!p.apart) p.apart = s.value > slack;
  const Real level = p.apart ? 0 : -slack;
  if (s.value < level) {
    p.touch = p.sampled ? bisect(p, p.at, t, level) : t;
    return;
  }
  const Real step = safeStep(p, t, s, far.has_value(), p.apart ? 0 : 2 * slack);
  p.at = t;
  p.sampled = true;
  p.next = t + std::max(step, kShortest);
}

std::optional<Separation> BruteForce::farApart(const Pair& p, Real t) {
  const Solid &a = solid(p.a), &b = solid(p.b);
  const Vector xa = body_(p.a).flight.positionAt(t), xb = body_(p.b).flight.positionAt(t);
  Separation s;
  if (a.kind == Solid::Kind::half_space || b.kind == Solid::Kind::half_space) {
    const bool first = a.kind == Solid::Kind::half_space;
    const Solid &plane = first ? a : b, &other = first ? b : a;
    const Vector n = stateAt(first ? p.a : p.b, t).R * plane.normal;
    s.n = first ? Vector(-n) : n;
    s.value = s.n.dot(xa - xb) - plane.offset - other.reach();
  } else {
    const Vector d = xa - xb;
    s.n = d.normalized();
    s.value = d.norm() - a.reach() - b.reach();
  }
  if (s.value < kAmple) return {};
  return s;
}

// How fast the separating direction turns, by its change over a moment: whatever it is, the bound below holds; it is
// only wider the better the turning direction stays with the features that face each other.
Vector BruteForce::turning(const Pair& p, Real t, const Separation& s) {
  if (s.value > kNear || solid(p.a).kind == Solid::Kind::half_space || solid(p.b).kind == Solid::Kind::half_space)
    return Vector::Zero();
  Vector dn = (separationAt(p.a, p.b, t + kMoment).n - s.n) / kMoment;
  dn -= dn.dot(s.n) * s.n;
  return dn;
}

// The separation along the turning direction after h is at least F(h), concave with F(0) > 0: positive up to its only
// zero.
Real BruteForce::safeStep(const Pair& p, Real t, const Separation& s, bool as_balls, Real slack) {
  const Real start = s.value + slack;
  if (!(start > 0)) return 0;
  const Flight &fa = body_(p.a).flight, &fb = body_(p.b).flight;
  const Vector gravity = fa.acceleration() - fb.acceleration(), velocity = fa.velocityAt(t) - fb.velocityAt(t);
  std::vector<Line> upper{{0, 0}}, lower{{s.value, s.n.dot(velocity)}};
  Real bend = std::max(Real(0), -s.n.dot(gravity));
  if (!as_balls) {
    const Solid &a = solid(p.a), &b = solid(p.b);
    const Kinematic ka = stateAt(p.a, t), kb = stateAt(p.b, t);
    const Vector dn = turning(p, t, s);
    const Real turn = dn.norm();
    lower = linesOf(a, ka, ka.x, s.n, dn);
    upper = linesOf(b, kb, ka.x, s.n, dn);
    bend += cornerAcceleration(a, fa) + cornerAcceleration(b, fb);
    if (turn > 0) {  // (n . d)'' = n . d'' + 2 n' . d' + n'' . d for the vector d between two corners
      const Real speed =
          velocity.norm() + gravity.norm() * kLongest + fa.spinBound() * a.reach() + fb.spinBound() * b.reach();
      const Real apart = (ka.x - kb.x).norm() + a.reach() + b.reach() + speed * kLongest;
      bend += gravity.norm() * turn * kLongest + 2 * turn * speed + turn * turn * apart;
    }
  }
  const auto F = [&](Real h) {
    Real low = lower[0].position + lower[0].rate * h, high = upper[0].position + upper[0].rate * h;
    for (const Line& l : lower) low = std::min(low, l.position + l.rate * h);
    for (const Line& l : upper) high = std::max(high, l.position + l.rate * h);
    return low - high - bend * h * h / 2;
  };
  // radii and the offset of a plane do not change with h, so F is made to start at the separation that was measured
  const Real shift = start - F(0);
  if (F(kLongest) + shift > 0) return kLongest;
  Real safe = kShortest, unsafe = kLongest;
  while (unsafe > 1.2L * safe) {
    const Real middle = std::sqrt(safe * unsafe);
    (F(middle) + shift > 0 ? safe : unsafe) = middle;
  }
  return safe;
}

Real BruteForce::bisect(const Pair& p, Real before, Real after, Real level) {
  for (int round = 0; round < 64; ++round) {
    const Real middle = before + (after - before) / 2;
    (separationAt(p.a, p.b, middle).value < level ? after : before) = middle;
  }
  return after;
}

}  // namespace carom::brute
