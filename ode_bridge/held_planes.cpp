// SPDX-License-Identifier: MIT
#include "ode_bridge/held_planes.hpp"

#include <algorithm>
#include <cmath>

#include "adjoint/base/errors.h"
#include "ode_bridge/rounding.hpp"
#include "ode_bridge/time_to.hpp"
#include "ode_bridge/touching.hpp"

namespace carom::ode_bridge_detail {
namespace {

// What is within so many tolerances of contact of a held plane lies in it.
constexpr double kInPlane = 10;
// Normals that differ by less are one; points on a line through others by this share of the size go with these.
constexpr double kSamePlane = 1e-9;
constexpr int kMostPlaneSteps = 1'000'000;

const Piece& pieceOf(const Placed& body, int piece) { return body.solid->pieces[static_cast<std::size_t>(piece)]; }

// How far points span: a basis of their differences from the first one.
struct Span {
  std::vector<Vec3> points;
  std::vector<Vec3> basis;
  double size = 1;

  void add(const Vec3& p) {
    if (points.empty()) {
      points.push_back(p);
      return;
    }
    if (const Vec3 rest = across(p); rest.norm() > kSamePlane * size) basis.push_back(rest.normalized());
    points.push_back(p);
  }
  Vec3 across(const Vec3& p) const {
    Vec3 rest = p - points.front();
    for (const Vec3& e : basis) rest -= e.dot(rest) * e;
    return rest;
  }
  bool contains(const Vec3& p) const { return !points.empty() && across(p).norm() <= kSamePlane * size; }
  bool isPlane() const { return basis.size() >= 2; }
};

// The points of a feature that lie in the plane of its contact, in the axes of its solid.
void addPointsInPlane(const Solid& solid, Family family, int index, const Vec3& contact, Span& span) {
  const auto at = static_cast<std::size_t>(index);
  switch (family) {
    case Family::vertex:
      span.add(solid.vertices[at].point);
      return;
    case Family::edge: {
      const SolidEdge& edge = solid.edges[at];
      if (isSwept(edge)) {
        span.add(contact);
        return;
      }
      for (const double end : {-1.0, 1.0}) span.add(edge.point + end * edge.half_length * edge.direction);
      return;
    }
    case Family::face: {
      const SolidFace& face = solid.faces[at];
      const Vec3 u = face.direction.unitOrthogonal();
      span.add(face.point), span.add(face.point + u), span.add(face.point + face.direction.cross(u));
      return;
    }
    case Family::rim:
      span.add(contact);
      return;
  }
}

// How far the lowest point of a rim is below its middle: radius |across|, across = axis x n, whose second derivative is
// no larger than `bend`.
struct RimGap {
  double radius = 0, bend = 0;
  Vec3 across = Vec3::Zero(), rate = Vec3::Zero();

  double below(double h) const { return radius * (across + h * rate).norm(); }
  // Where the rim is flat: as it will be.
  double belowRate() const {
    const double sine = across.norm();
    return radius * (sine > 0 ? across.dot(rate) / sine : rate.norm());
  }
  // No later, and up to `limit`, than a gap falls to 0 that is c > 0 now, and of which what belongs to the middle grows at
  // `rate_of_middle` with a second derivative of no more than `bend_of_middle`: the root of a concave function, from
  // below by chords.
  double timeTo(double c, double rate_of_middle, double bend_of_middle, double limit) const {
    const double half = 0.5 * (bend_of_middle + radius * bend), start = below(0);
    const auto left = [&](double h) { return c + h * (rate_of_middle - half * h) - (below(h) - start); };
    double low = 0, high = limit, at_low = c, at_high = left(high);
    if (at_high >= 0) return limit;
    for (int round = 0; round < 100 && high - low > 1e-3 * high; ++round) {
      const double middle = 0.5 * (low + high), at_middle = left(middle);
      if (at_middle < 0) {
        high = middle, at_high = at_middle;
      } else {
        low = middle, at_low = at_middle;
      }
    }
    return low + (high - low) * (at_low / (at_low - at_high));
  }
};

}  // namespace

HeldPlanes::HeldPlanes(const Placed& a, const Placed& b, std::span<const FeaturePair> held) : a_(a), b_(b) {
  struct Found {
    Plane plane;
    Span of_a, of_b;
  };
  std::vector<Found> found;
  const double tolerance = touchTolerance(a, b);
  for (const FeaturePair& f : held) {
    const auto kind = static_cast<GapKind>(f.kind);
    const ContactPoint c = contactAt(a, b, f);
    if (!c.normal.allFinite() || !std::isfinite(c.gap)) continue;
    const Family of_a = familyOfFirst(kind), of_b = familyOfSecond(kind);
    const auto levelOf = [&] {
      if (of_b == Family::face)
        return c.normal.dot(b.world(b.solid->faces[static_cast<std::size_t>(f.b)].point) - b.k.x);
      if (of_a == Family::face)
        return c.normal.dot(a.world(a.solid->faces[static_cast<std::size_t>(f.a)].point) - b.k.x);
      return c.normal.dot(c.point - b.k.x);
    };
    const double level = levelOf(), room = kInPlane * tolerance + std::abs(c.gap);
    auto same = std::ranges::find_if(found, [&](const Found& o) {
      return (o.plane.n - c.normal).norm() <= kSamePlane && std::abs(o.plane.level - level) <= room + o.plane.room;
    });
    if (same == found.end()) {
      Found fresh;
      fresh.plane.frame = Frame::crossed;
      fresh.plane.n = c.normal, fresh.plane.level = level, fresh.plane.room = room;
      const auto size = [](const Placed& p) { return p.solid->plane ? 1.0 : p.solid->bound(); };
      fresh.of_a.size = size(a), fresh.of_b.size = size(b);
      same = found.insert(found.end(), std::move(fresh));
    }
    same->plane.held.push_back(f);
    if (of_a == Family::edge && of_b == Family::edge && same->plane.held.size() == 1) {
      same->plane.edge_a = a.solid->edges[static_cast<std::size_t>(f.a)];
      same->plane.edge_b = b.solid->edges[static_cast<std::size_t>(f.b)];
    }
    addPointsInPlane(*a.solid, of_a, f.a, a.k.R.transpose() * (c.point - a.k.x), same->of_a);
    addPointsInPlane(*b.solid, of_b, f.b, b.k.R.transpose() * (c.point - b.k.x), same->of_b);
  }
  for (Found& each : found) {
    Plane& plane = each.plane;
    const auto goesWith = [&](Frame frame, const Placed& body, const Span& span) {
      plane.frame = frame;
      plane.normal = body.k.R.transpose() * plane.n;
      plane.point = span.points.front();
    };
    if (each.of_b.isPlane()) {
      goesWith(Frame::body_b, b, each.of_b);
    } else if (each.of_a.isPlane()) {
      goesWith(Frame::body_a, a, each.of_a);
    } else {
      const Vec3 across = (a.k.R * plane.edge_a.direction).cross(b.k.R * plane.edge_b.direction);
      plane.sign = across.dot(plane.n) < 0 ? -1 : 1;
    }
    planes_.push_back(std::move(plane));
    Plane& kept = planes_.back();
    addFollowers(kept);
    const auto inPlane = [&](const Follower& f) {
      const Placed& body = f.of_a ? a_ : b_;
      const Span& span = f.of_a ? each.of_a : each.of_b;
      if (!span.contains(f.feature.point)) return false;
      return !f.is_rim || (body.k.R * f.feature.direction).cross(kept.n).norm() <= kSamePlane;
    };
    std::erase_if(kept.followers, inPlane);
  }
}

// Everything of the pieces with held features that is not held itself; what a plane goes with lies behind it.
void HeldPlanes::addFollowers(Plane& plane) {
  for (const bool of_a : {true, false}) {
    if (plane.frame == (of_a ? Frame::body_a : Frame::body_b)) continue;
    const Placed& body = of_a ? a_ : b_;
    const Solid& solid = *body.solid;
    if (solid.plane || solid.ball) continue;
    std::vector<int> vertices, rims;
    for (std::size_t piece = 0; piece < solid.pieces.size(); ++piece) {
      if (!holds(plane, of_a, static_cast<int>(piece))) continue;
      for (int v : solid.featuresOf(solid.pieces[piece], Family::vertex)) vertices.push_back(v);
      for (int r : solid.featuresOf(solid.pieces[piece], Family::rim)) rims.push_back(r);
    }
    const auto add = [&](std::vector<int>& features, Family family) {
      std::ranges::sort(features);
      features.erase(std::unique(features.begin(), features.end()), features.end());
      for (int i : features) {
        const Feature& feature = solid.feature(family, i);
        if (feature.mark) continue;
        const bool is_held = std::ranges::any_of(plane.held, [&](const FeaturePair& f) {
          const auto kind = static_cast<GapKind>(f.kind);
          return (of_a ? familyOfFirst(kind) : familyOfSecond(kind)) == family && (of_a ? f.a : f.b) == i;
        });
        if (!is_held) plane.followers.push_back({of_a, feature, family == Family::rim});
      }
    };
    add(vertices, Family::vertex);
    add(rims, Family::rim);
  }
}

bool HeldPlanes::holds(const Plane& plane, bool of_a, int piece) const {
  const Placed& body = of_a ? a_ : b_;
  return std::ranges::any_of(plane.held, [&](const FeaturePair& f) {
    const auto kind = static_cast<GapKind>(f.kind);
    const auto features = body.solid->featuresOf(pieceOf(body, piece), of_a ? familyOfFirst(kind) : familyOfSecond(kind));
    return std::ranges::find(features, of_a ? f.a : f.b) != features.end();
  });
}

// Whether a piece lies beyond the plane, and goes on doing so: it goes with it, or does not turn.
bool HeldPlanes::staysBeyond(const Plane& plane, bool of_a, int piece) const {
  if (holds(plane, of_a, piece)) return true;
  const Placed& body = of_a ? a_ : b_;
  const PlacedPiece p{&body, &pieceOf(body, piece)};
  if (p.halfSpace()) return false;
  const bool rigid = plane.frame == (of_a ? Frame::body_a : Frame::body_b);
  const bool stands = !(body.spin > 0) && plane.frame != Frame::crossed && !((of_a ? b_ : a_).spin > 0);
  if (!rigid && !stands) return false;
  const Vec3 n = of_a ? plane.n : Vec3(-plane.n);
  const double level = of_a ? plane.level + plane.n.dot(b_.k.x - a_.k.x) : -plane.level;
  return -extentAlong(p, -n) - p.piece->radius >= level - plane.room;
}

bool HeldPlanes::keepApart(int piece_a, int piece_b) const {
  return std::ranges::any_of(planes_, [&](const Plane& plane) {
    return staysBeyond(plane, true, piece_a) && staysBeyond(plane, false, piece_b);
  });
}

HeldPlanes::Reach HeldPlanes::reachAt(const PairMotion& pair, double t, double until, int steps) const {
  if (steps > kMostPlaneSteps)
    throw NotComputable("it takes more than " + std::to_string(kMostPlaneSteps) + " steps: they go along each other too closely");
  if (pair.work) pair.work->step();
  pair.arc_a.extendTo(t);
  pair.arc_b.extendTo(t);
  const Placed a(*a_.solid, pair.arc_a, t), b(*b_.solid, pair.arc_b, t);
  const double tolerance = touchTolerance(a, b), spin = a.spin + b.spin;
  Reach reach{until - t, false};
  if (spin > 0) reach.step = std::min(reach.step, 0.5 / spin);
  for (const Plane& plane : planes_) {
    // n and its bounds |n'| <= n1, |n''| <= n2; Q a point of the plane, of body q
    Vec3 n, dn, Q;
    double n1 = 0, n2 = 0;
    const Placed* q = &b;
    if (plane.frame == Frame::crossed) {
      const Vec3 ea = a.k.R * plane.edge_a.direction, eb = b.k.R * plane.edge_b.direction;
      const Vec3 c = ea.cross(eb), dc = a.k.w.cross(ea).cross(eb) + ea.cross(b.k.w.cross(eb));
      const double sine = c.norm();
      if (!(sine > 0)) continue;
      n = plane.sign / sine * c;
      dn = plane.sign / sine * (dc - n * n.dot(dc) * 1.0);
      n1 = spin / (0.5 * sine), n2 = (spin * spin + a.spin_rate + b.spin_rate) / (0.5 * sine) + 3 * n1 * n1;
      if (spin > 0) reach.step = std::min(reach.step, 0.5 * sine / spin);
      Q = b.world(plane.edge_b.point);
    } else {
      q = plane.frame == Frame::body_a ? &a : &b;
      n = q->k.R * plane.normal, dn = q->k.w.cross(n);
      n1 = q->spin, n2 = q->spin * q->spin + q->spin_rate;
      Q = q->world(plane.point);
    }
    const Vec3 rq = Q - q->k.x, dQ = q->k.v + q->k.w.cross(rq);
    const auto pull = [](const Placed& p, double arm) {
      return p.acceleration.norm() + p.variation + (p.spin * p.spin + p.spin_rate) * arm;
    };
    for (const Follower& f : plane.followers) {
      const Placed& body = f.of_a ? a : b;
      const double sign = f.of_a ? 1 : -1;
      const Vec3 w = body.world(f.feature.point), r = w - body.k.x, d = w - Q;
      const Vec3 dd = body.k.v + body.k.w.cross(r) - dQ;
      double gap = sign * n.dot(d) - f.feature.radius, rate = sign * (dn.dot(d) + n.dot(dd));
      const double arm = r.norm() + f.feature.rim;
      const double second = &body == q ? 0 : pull(body, arm) + pull(*q, rq.norm());
      const double win = reach.step, fastest = dd.norm() + body.spin * f.feature.rim + second * win;
      const double furthest = d.norm() + f.feature.rim + fastest * win;
      double bend = n2 * furthest + 2 * n1 * fastest + second;
      if (plane.frame == Frame::body_b && !(b.spin > 0)) {  // the plane stands: only what is along its normal counts
        bend = std::abs(n.dot(body.acceleration - b.acceleration)) + body.variation + b.variation +
               (body.spin * body.spin + body.spin_rate) * arm;
      }
      RimGap rim;
      if (f.is_rim) {
        const Vec3 axis = body.k.R * f.feature.direction;
        rim.radius = f.feature.rim;
        rim.across = axis.cross(n), rim.rate = body.k.w.cross(axis).cross(n) + axis.cross(dn);
        rim.bend = body.spin * body.spin + body.spin_rate + 2 * body.spin * n1 + n2;
        gap -= rim.below(0), rate -= rim.belowRate();
      }
      const double still = kStill * (dd.norm() + body.spin * arm + a.k.v.norm() + b.k.v.norm());
      if (gap <= tolerance && rate < -still) {
        reach.touches = true;
        reach.step = std::min(reach.step, timeTo(tolerance, -rate, bend));
        continue;
      }
      const double c = std::max(gap, 0.0) + tolerance * (gap <= tolerance ? 1 : 0);
      reach.step = std::min(reach.step, f.is_rim ? rim.timeTo(c, rate + rim.belowRate(), bend, reach.step)
                                                 : timeTo(c, -rate, bend));
    }
  }
  return reach;
}

}  // namespace carom::ode_bridge_detail
