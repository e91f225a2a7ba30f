// SPDX-License-Identifier: MIT
#include "tests/pairs/encounter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace carom::pairs {
namespace {

constexpr Real kTouching = 1e-13L;  // m: from here on Newton's method
constexpr Real kNear = 3e-3L;       // m: from here on longer steps are worth their price
constexpr Real kRounding = 1e-15L;  // m, generous for distances in long double
constexpr Real kAmple = 0.02L;      // m between the whole bodies' balls: no need to look at their features
constexpr Real kFine = 1e-7L;       // m: below, sharp features that meet at their ends have no provable distance
constexpr Real kLongest = 0.1L;     // s, that frozen features are followed
constexpr Real kShort = 0.99L;     // of a safe step, so that none ends in the contact itself
constexpr long kMostSteps = 4000;  // of one encounter; a pass that takes more is next to grazing
constexpr Real kGrazing = 0.01L;   // least n.u / |u|
constexpr Real kSlow = 1e-3L;      // m/s, least n.u
constexpr Real kParallel = 1e-3L;  // least sine between two curves that cross, or a rim's axis and a normal

Vector tangentAt(const Feature& f, const Vector& p) {
  return f.kind == FeatureKind::circle ? unit(cross(f.along, p - f.at)) : f.along;
}

// Sine between the curves, or between the normal and a rim's axis; 1 for features that meet at a point.
Real crossing(const Feature& a, const Feature& b, const Candidate& c) {
  const bool curve_a = a.kind == FeatureKind::line || a.kind == FeatureKind::circle;
  const bool curve_b = b.kind == FeatureKind::line || b.kind == FeatureKind::circle;
  if (curve_a && curve_b) return norm(cross(tangentAt(a, c.p), tangentAt(b, c.q)));
  if (curve_a && b.kind == FeatureKind::plane) return norm(cross(a.along, b.along));
  if (curve_b && a.kind == FeatureKind::plane) return norm(cross(a.along, b.along));
  return 1;
}

bool sameTouch(const std::optional<Touch>& a, const Touch& b) {
  return a && norm(a->normal - b.normal) <= Encounter::kTie && norm(a->point - b.point) <= Encounter::kTie;
}
// A moment before an impact, at which sharp features still know their sides.
Real justBefore(const FirstImpact& impact) { return impact.time - kTouching / -impact.approach; }

}  // namespace

Encounter::Side Encounter::sideOf(const Scene& scene, const Body& body) {
  const Solid solid(body.shape);
  const brute::MassProperties mass = brute::massOf(body);
  const brute::Rotation q = body.orientation.cast<Real>().normalized();
  brute::Flight flight;
  if (body.fixed) {
    flight = brute::Flight::fixedAt(brute::widen(body.position), q);
  } else {
    const brute::Matrix R_shape = q.toRotationMatrix(), R = R_shape * mass.axes;
    const brute::Vector L = R * mass.inertia.asDiagonal() * R.transpose() * brute::widen(body.angular_velocity);
    flight = brute::Flight(mass, brute::widen(scene.gravity), 0, brute::widen(body.position) + R_shape * mass.center,
                           brute::Rotation(R), brute::widen(body.velocity), L);
  }
  return {mass, flight, solid, Placed(solid), solid.reachFrom(brute::exactly(mass.center)), {}};
}

Encounter::Encounter(const Scene& scene)
    : a_(sideOf(scene, scene.bodies.at(0))), b_(sideOf(scene, scene.bodies.at(1))) {
  // the placed pieces know where their solids are kept
  a_.placed = Placed(a_.solid), b_.placed = Placed(b_.solid);
}

void Encounter::moveTo(Real t) {
  for (Side* side : {&a_, &b_}) {
    side->state = side->flight.at(t);
    const brute::Matrix R = side->state.R * side->mass.axes.transpose();
    side->placed.moveTo({brute::exactly(brute::Vector(side->state.x - R * side->mass.center)), brute::exactly(R)});
  }
}

Real Encounter::ballGap() const {
  if (isHalfSpace(a_.solid) || isHalfSpace(b_.solid)) return -1;
  const Solid::Ball &a = a_.placed.whole(), &b = b_.placed.whole();
  return norm(a.centre - b.centre) - a.radius - b.radius;
}

// No two points of the bodies come nearer to each other than at v + g h, h after now.
Real Encounter::safeStep(Real distance) const {
  const Real g = (a_.flight.acceleration() - b_.flight.acceleration()).norm(), speed = this->speed();
  return 2 * distance / (speed + std::sqrt(speed * speed + 2 * g * distance) + 1e-30L);
}

Drift Encounter::driftOf(const Side& side) {
  if (!side.mass.moving) return {};
  const Real spin = side.flight.spinBound();
  return {brute::exactly(side.state.x), brute::exactly(side.state.v), brute::exactly(side.state.w),
          brute::exactly(side.flight.acceleration()), (spin * spin + side.flight.spinRateBound()) * side.reach};
}

// A time for which slabs stay open between all pieces: those farther apart than any point can move, and the others by
// the first-order motion of their points and a bound on what it leaves out.
Real Encounter::longStep(Real distance, const Candidate& nearest) const {
  const Drift a = driftOf(a_), b = driftOf(b_);
  const Real bend = a.bend + b.bend + norm(a.g - b.g);
  Real h = std::min(std::sqrt(2 * distance / (bend + 1e-9L)), kLongest);
  if (h < 2 * safeStep(distance)) return 0;
  const Vector across_gap = unit(nearest.p - nearest.q);
  for (const auto& [i, j] : piecesWithin(a_.placed, b_.placed, travelIn(h))) {
    const Piece &p = a_.placed.pieces()[i], &q = b_.placed.pieces()[j];
    // The bound is concave in h: a slab that is open now and then stays open between.
    const auto parts = [&](const Vector& n) { return slabAfter(p, a, q, b, n, h) > kRounding; };
    const auto partsFromNow = [&](const Vector& n) { return parts(n) && slab(p, q, n) > kRounding; };
    // Most pieces are parted by what parts the nearest ones, or along the line between their middles.
    const Vector middles = a_.placed.balls()[i].centre - b_.placed.balls()[j].centre;
    if (!isHalfSpace(p) && !isHalfSpace(q) && (partsFromNow(across_gap) || partsFromNow(unit(middles)))) continue;
    const std::optional<Candidate> c = nearestOfPieces(a_.placed, i, b_.placed, j, travelIn(h));
    if (!c) continue;
    const Separation apart = separationOf(a_.placed, b_.placed, *c);
    while (!parts(apart.normal)) {
      h /= 2;
      if (h < 1e-12L) return 0;
    }
  }
  return kShort * h;
}

// How far any point of one body may get, seen from the other, in h seconds from now.
Real Encounter::travelIn(Real h) const {
  const Real g = (a_.flight.acceleration() - b_.flight.acceleration()).norm();
  return 1.01L * (speed() + h / 2 * g) * h;
}

Real Encounter::speed() const {
  Real speed = (a_.state.v - b_.state.v).norm();
  for (const Side* side : {&a_, &b_})
    if (side->mass.moving && side->flight.spinBound() > 0) speed += side->flight.spinBound() * side->reach;
  return speed;
}

Distance Encounter::distanceAt(Real t, const Known& known) {
  moveTo(t);
  return distanceOf(a_.placed, b_.placed, known);
}

std::optional<Encounter::Gap> Encounter::gapAt(const Candidate& features, Real t) {
  moveTo(t);
  const auto touch = features.touch(a_.placed, b_.placed);
  if (!touch) return {};
  const auto velocity = [&](const Side& s) {
    if (!s.mass.moving) return brute::Vector(brute::Vector::Zero());
    return brute::Vector(s.state.v + s.state.w.cross(brute::widen(touch->point) - s.state.x));
  };
  const Vector u = brute::exactly(brute::Vector(velocity(a_) - velocity(b_)));
  return Gap{*touch, dot(touch->normal, u), norm(u)};
}

std::optional<FirstImpact> Encounter::firstImpact(Real until, bool patient) {
  Candidate hint;
  Known known;
  Real t = 0;
  const auto doubtful = [&t](const char* why) {
    FirstImpact impact;
    impact.time = t, impact.doubt = why;
    return impact;
  };
  for (long step = 0; t < until; ++step) {
    ++steps_;
    moveTo(t);
    Real safe = ballGap(), distance = kInfinite;
    if (!(safe > kAmple)) {
      const Distance d = distanceOf(a_.placed, b_.placed, known);
      distance = d.nearest.distance;
      hint = d.nearest, safe = d.proven;
      if (closest_.a.piece < 0 || distance < closest_.distance) closest_ = d.nearest, closest_time_ = t;
      if (distance > 1e-6L && distance < 1) worst_proof_ = std::max(worst_proof_, 1 - safe / distance);
      if (distance < kTouching) return impactOf(d.nearest, t);
      if (!(safe > 0.5L * distance)) {
        if (!(distance < kFine)) throw std::runtime_error("the brute-force distance cannot be proven");
        return doubtful("ends of sharp features meet");
      }
    }
    if (step > kMostSteps) return doubtful("a pass next to grazing");
    const Real plain = kShort * safeStep(safe);
    const Real forward = patient || safe > kNear ? plain : std::max(plain, longStep(safe, hint));
    known = {};
    if (distance < kInfinite) known = {&hint, distance + travelIn(forward) + kRounding};
    t += forward;
  }
  return {};
}

// First zero of the gap of frozen features: Newton's method, or between now and the gap's least if that fails.
std::optional<Real> Encounter::zeroOf(const Candidate& features, Real from) {
  Real t = from;
  for (int round = 0; round < 60; ++round) {
    const auto gap = gapAt(features, t);
    if (!gap || !(gap->rate < 0)) break;
    const Real change = -gap->touch.gap / gap->rate;
    t += change;
    if (!(std::abs(t - from) < kLongest)) break;
    if (std::abs(change) < 1e-17L) return t;
  }
  const auto least = leastGap(features, from);
  if (!least || *least < from || !(gapAt(features, *least)->touch.gap < 0)) return {};
  Real before = from, after = *least;
  for (int round = 0; round < 80; ++round) {
    const Real middle = before + (after - before) / 2;
    (gapAt(features, middle)->touch.gap < 0 ? after : before) = middle;
  }
  return before;
}

// Newton's method on the rate, whose own rate is a central difference (its error only slows the method down).
std::optional<Real> Encounter::leastGap(const Candidate& features, Real from) {
  constexpr Real h = 1e-6L;
  Real t = from;
  for (int round = 0; round < 60; ++round) {
    const auto low = gapAt(features, t - h), high = gapAt(features, t + h), here = gapAt(features, t);
    if (!low || !high || !here) return {};
    const Real bend = (high->rate - low->rate) / (2 * h);
    if (!(bend > 0)) return {};
    const Real change = -here->rate / bend;
    t += change;
    if (!(std::abs(t - from) < kLongest)) return {};
    if (std::abs(change) < 1e-15L) return t;
  }
  return {};
}

// The impact of bodies within 1e-13 m of each other.
FirstImpact Encounter::impactOf(const Candidate& nearest, Real now) {
  FirstImpact impact;
  impact.time = zeroOf(nearest, now).value_or(now);
  impact.features =
      a_.solid.pieces[nearest.a.piece].nameOf(nearest.a) + " on " + b_.solid.pieces[nearest.b.piece].nameOf(nearest.b);
  const auto gap = gapAt(nearest, impact.time);
  if (!gap) {
    impact.doubt = "ends of sharp features meet";
    return impact;
  }
  impact.nearest = nearest, impact.nearest.p = impact.nearest.q = gap->touch.point;
  impact.touch = gap->touch, impact.approach = gap->rate, impact.speed = gap->speed;
  impact.doubt = doubtOf(nearest, impact);
  if (!impact.doubt.empty()) return impact;
  moveTo(justBefore(impact));
  if (!provenApart(a_.placed, b_.placed)) throw std::runtime_error("the bodies overlap before their first impact");
  return impact;
}

// All candidates within a distance are the same touch, seen in pieces that share a feature.
bool Encounter::standsAlone(const Candidate& chosen, Real within) {
  const auto touch = chosen.touch(a_.placed, b_.placed);
  if (!touch) return false;
  for (const Candidate& c : candidatesWithin(a_.placed, b_.placed, within)) {
    if (!sameTouch(c.touch(a_.placed, b_.placed), *touch)) return false;
  }
  return true;
}

std::string Encounter::doubtOf(const Candidate& chosen, const FirstImpact& impact) {
  if (!(impact.approach < -kGrazing * impact.speed) || !(impact.approach < -kSlow)) return "a grazing touch";
  const Feature a = a_.placed.pieces()[chosen.a.piece].feature(chosen.a);
  const Feature b = b_.placed.pieces()[chosen.b.piece].feature(chosen.b);
  if (crossing(a, b, chosen) < kParallel) return "nearly parallel features";
  moveTo(justBefore(impact));
  return standsAlone(chosen, kTie * (1 + speed())) ? "" : "two feature pairs at once";
}

}  // namespace carom::pairs
