// SPDX-License-Identifier: MIT
#include "ode_bridge/held_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adjoint/base/errors.h"
#include "ode_bridge/affine_span.hpp"
#include "ode_bridge/rim_gap.hpp"
#include "ode_bridge/rounding.hpp"
#include "ode_bridge/time_to.hpp"
#include "ode_bridge/touching.hpp"

namespace carom::ode_bridge_detail {
namespace {

// What is within so many tolerances of contact of a held plane lies in it.
constexpr double kInPlane = 10;
// Normals that differ by less are one.
constexpr double kSamePlane = 1e-9;
constexpr int kMostPlaneSteps = 20'000;

const Piece& pieceOf(const Placed& body, int piece) { return body.solid->pieces[static_cast<std::size_t>(piece)]; }

// The points of a feature that lie in the plane of its contact, in the axes of its solid.
void addPointsInPlane(const Solid& solid, Family family, int index, const Vec3& contact, AffineSpan& span) {
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

// Whether a line of the side of a capsule, cylinder or cone ends at this vertex or rim: where the line lies in a plane it
// does, too.
bool endsAt(const Solid& solid, int edge, const Feature& end) {
  const SolidEdge& side = solid.edges[static_cast<std::size_t>(edge)];
  if (!isSwept(side) || side.part != end.part) return false;
  const Vec3 half = side.half_length * side.direction;
  const double room = kSamePlane * (side.half_length + side.radius);
  return std::min((side.point + half - end.point).norm(), (side.point - half - end.point).norm()) <= room;
}

}  // namespace

// A plane, and what is known to lie in it: of each body, in the axes of its solid.
struct HeldPlanes::Laid {
  Plane plane;
  AffineSpan of_a, of_b;
};

HeldPlanes::HeldPlanes(const Placed& a, const Placed& b, std::span<const FeaturePair> held) : a_(a), b_(b) {
  std::vector<Laid> laid;
  for (const FeaturePair& f : held) layThrough(f, laid);
  for (Laid& each : laid) {
    fixTo(each);
    planes_.push_back(std::move(each.plane));
    Plane& kept = planes_.back();
    addFollowers(kept);
    const auto inPlane = [&](const Follower& f) {
      const Placed& body = f.of_a ? a_ : b_;
      const AffineSpan& span = f.of_a ? each.of_a : each.of_b;
      if (!span.contains(f.feature.point)) return false;
      return !f.is_rim || (body.k.R * f.feature.direction).cross(kept.n).norm() <= kSamePlane;
    };
    std::erase_if(kept.followers, inPlane);
  }
}

// Adds a contact to the plane that it lies in; that is a new one where it lies in none of the others.
void HeldPlanes::layThrough(const FeaturePair& f, std::vector<Laid>& laid) const {
  const auto kind = static_cast<GapKind>(f.kind);
  const ContactPoint c = contactAt(a_, b_, f);
  if (!c.normal.allFinite() || !std::isfinite(c.gap)) return;
  const Family of_a = familyOfFirst(kind), of_b = familyOfSecond(kind);
  const auto levelOf = [&] {
    if (of_b == Family::face)
      return c.normal.dot(b_.world(b_.solid->faces[static_cast<std::size_t>(f.b)].point) - b_.k.x);
    if (of_a == Family::face)
      return c.normal.dot(a_.world(a_.solid->faces[static_cast<std::size_t>(f.a)].point) - b_.k.x);
    return c.normal.dot(c.point - b_.k.x);
  };
  const double level = levelOf(), room = kInPlane * touchTolerance(a_, b_) + std::abs(c.gap);
  auto same = std::ranges::find_if(laid, [&](const Laid& o) {
    return (o.plane.n - c.normal).norm() <= kSamePlane && std::abs(o.plane.level - level) <= room + o.plane.room;
  });
  if (same == laid.end()) {
    Laid fresh;
    fresh.plane.frame = Frame::crossed;
    fresh.plane.n = c.normal, fresh.plane.level = level, fresh.plane.room = room;
    const auto size = [](const Placed& p) { return p.solid->plane ? 1.0 : p.solid->bound(); };
    fresh.of_a = AffineSpan(size(a_)), fresh.of_b = AffineSpan(size(b_));
    same = laid.insert(laid.end(), std::move(fresh));
  }
  same->plane.held.push_back(f);
  const auto isCurve = [](Family family) { return family == Family::edge || family == Family::rim; };
  if (isCurve(of_a) && isCurve(of_b) && same->plane.held.size() == 1)
    same->plane.edge_a = a_.solid->feature(of_a, f.a), same->plane.edge_b = b_.solid->feature(of_b, f.b);
  addPointsInPlane(*a_.solid, of_a, f.a, a_.k.R.transpose() * (c.point - a_.k.x), same->of_a);
  addPointsInPlane(*b_.solid, of_b, f.b, b_.k.R.transpose() * (c.point - b_.k.x), same->of_b);
}

// Finds what the plane goes with.
void HeldPlanes::fixTo(Laid& laid) const {
  Plane& plane = laid.plane;
  const auto goesWith = [&](Frame frame, const Placed& body, const AffineSpan& span) {
    plane.frame = frame;
    plane.normal = body.k.R.transpose() * plane.n;
    plane.point = span.origin();
  };
  if (laid.of_b.isPlane()) {
    goesWith(Frame::body_b, b_, laid.of_b);
  } else if (laid.of_a.isPlane()) {
    goesWith(Frame::body_a, a_, laid.of_a);
  } else if (isRimOf(plane.edge_a) != isRimOf(plane.edge_b)) {
    plane.frame = Frame::rim;
    if (plane.held.size() == 1) plane.side = sideOfCap(plane);
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
          const Family held = of_a ? familyOfFirst(kind) : familyOfSecond(kind);
          const int which = of_a ? f.a : f.b;
          return (held == family && which == i) || (held == Family::edge && endsAt(solid, which, feature));
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
  const bool turns = plane.frame == Frame::crossed || plane.frame == Frame::rim;
  const bool stands = !(body.spin > 0) && !turns && !((of_a ? b_ : a_).spin > 0);
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

HeldPlanes::Approach HeldPlanes::approachOf(const Follower& f, const Plane& plane, const Lying& p, const Placed& a,
                                            const Placed& b, double window) const {
  const Placed& body = f.of_a ? a : b;
  const double sign = f.of_a ? 1 : -1;
  const Vec3 w = body.world(f.feature.point), r = w - body.k.x, d = w - p.point;
  const Vec3 dd = body.k.v + body.k.w.cross(r) - p.velocity;
  Approach out;
  out.gap = sign * (p.n.dot(d) - p.beyond) - f.feature.radius, out.rate = sign * (p.dn.dot(d) + p.n.dot(dd));
  const auto pull = [](const Placed& of, double arm) {
    return of.acceleration.norm() + of.variation + (of.spin * of.spin + of.spin_rate) * arm;
  };
  const double arm = r.norm() + f.feature.rim;
  const double second = &body == p.with ? 0 : pull(body, arm) + pull(*p.with, p.arm.norm());
  const double fastest = dd.norm() + body.spin * f.feature.rim + second * window;
  const double furthest = d.norm() + f.feature.rim + fastest * window;
  out.bend = p.n2 * furthest + 2 * p.n1 * fastest + second;
  if (plane.frame == Frame::body_b && !(b.spin > 0)) {  // the plane stands: only what is along its normal counts
    out.bend = std::abs(p.n.dot(body.acceleration - b.acceleration)) + body.variation + b.variation +
               (body.spin * body.spin + body.spin_rate) * arm;
  }
  if (f.is_rim) {
    const Vec3 axis = body.k.R * f.feature.direction;
    out.rim.radius = f.feature.rim;
    out.rim.across = axis.cross(p.n), out.rim.rate = body.k.w.cross(axis).cross(p.n) + axis.cross(p.dn);
    out.rim.bend = body.spin * body.spin + body.spin_rate + 2 * body.spin * p.n1 + p.n2;
    out.gap -= out.rim.below(0), out.rate -= out.rim.belowRate();
  }
  out.speed = dd.norm() + body.spin * arm + a.k.v.norm() + b.k.v.norm();
  return out;
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
  const auto look = [&](const Approach& to, bool is_rim) {
    const bool there = to.gap <= tolerance;
    if (there && to.rate < -kStill * to.speed) {
      reach.touches = true;
      reach.step = std::min(reach.step, timeTo(tolerance, -to.rate, to.bend));
      return;
    }
    const double room = std::max(to.gap, 0.0) + tolerance * (there ? 1 : 0);
    reach.step = std::min(reach.step, is_rim ? to.rim.timeTo(room, to.rate + to.rim.belowRate(), to.bend, reach.step)
                                             : timeTo(room, -to.rate, to.bend));
  };
  for (const Plane& plane : planes_) {
    if (plane.frame == Frame::rim && plane.side != 0) {
      Approach to = levelOfCap(plane, a, b);
      to.gap *= plane.side, to.rate *= plane.side;
      look(to, false);
    }
    const std::optional<Lying> p = lie(plane, a, b);
    if (!p) continue;
    reach.step = std::min(reach.step, p->holds_for);
    for (const Follower& f : plane.followers) look(approachOf(f, plane, *p, a, b, reach.step), f.is_rim);
  }
  return reach;
}

}  // namespace carom::ode_bridge_detail
