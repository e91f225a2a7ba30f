// SPDX-License-Identifier: MIT
#include "ode_bridge/persistent_planes.hpp"

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

constexpr int kMostPlaneSteps = 20'000;
// What is nearer to a plane than so many tolerances of contact may glide along it.
constexpr double kNear = 100;

const Piece& pieceOf(const Placed& body, int piece) { return body.solid->pieces[static_cast<std::size_t>(piece)]; }

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

// Whether something has gone through the plane, as it may beside the body that holds.
bool PersistentPlanes::isBroken(const Plane& plane) const {
  return std::ranges::any_of(plane.followers, [&](const Follower& f) {
    const Placed& body = f.of_a ? a_ : b_;
    const double height = plane.n.dot(body.world(f.feature.point) - b_.k.x) - plane.level;
    const double rim = f.is_rim ? f.feature.rim * (body.k.R * f.feature.direction).cross(plane.n).norm() : 0;
    return (f.of_a ? height : -height) - f.feature.radius - rim < -plane.room;
  });
}

// Everything of the pieces with held features that is not held itself; what a plane goes with lies behind it.
void PersistentPlanes::addFollowers(Plane& plane) {
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
        // a rim that crosses an edge may still come to the plane of a face
        const auto isAt = [&](const PersistentFeature& held) {
          const bool stays = family != Family::rim || held.at_face || plane.frame == Frame::crossed || plane.frame == Frame::rim;
          return (held.family == family && held.index == i && stays) || (held.family == Family::edge && endsAt(solid, held.index, feature));
        };
        if (!anyPersistent(plane, of_a, isAt)) plane.followers.push_back({of_a, feature, family == Family::rim});
      }
    };
    add(vertices, Family::vertex);
    add(rims, Family::rim);
  }
}

// Whether a feature of a or of b that lies in the plane is one that is( PersistentFeature) true of.
template <class Is>
bool PersistentPlanes::anyPersistent(const Plane& plane, bool of_a, const Is& is) const {
  const auto isOwn = [&](const FeaturePair& f) {
    const auto kind = static_cast<GapKind>(f.kind);
    const Family first = familyOfFirst(kind), second = familyOfSecond(kind);
    return of_a ? is(PersistentFeature{first, f.a, second == Family::face}) : is(PersistentFeature{second, f.b, first == Family::face});
  };
  if (std::ranges::any_of(plane.held, isOwn)) return true;
  return of_a == moves_a_ && std::ranges::any_of(plane.held_elsewhere, is);
}

bool PersistentPlanes::holds(const Plane& plane, bool of_a, int piece) const {
  const Placed& body = of_a ? a_ : b_;
  return anyPersistent(plane, of_a, [&](const PersistentFeature& held) {
    const auto features = body.solid->featuresOf(pieceOf(body, piece), held.family);
    return std::ranges::find(features, held.index) != features.end();
  });
}

// Whether a piece lies beyond the plane, and goes on doing so: it goes with it, or does not turn.
bool PersistentPlanes::staysBeyond(const Plane& plane, bool of_a, int piece) const {
  if (holds(plane, of_a, piece)) return true;
  const Placed& body = of_a ? a_ : b_;
  const PlacedPiece p{&body, &pieceOf(body, piece)};
  const bool rigid = plane.frame == (of_a ? Frame::body_a : Frame::body_b);
  if (p.halfSpace()) {  // beside what holds the other body: it ends at the plane itself, or not at all
    if (!rigid || plane.held_elsewhere.empty()) return false;
    const SolidFace& face = body.solid->faces[0];
    const Vec3 n = of_a ? Vec3(-plane.n) : plane.n, outward = body.k.R * face.direction;
    const double level = of_a ? -plane.level : plane.level;
    return (outward - n).norm() <= kSamePlane && n.dot(body.world(face.point) - b_.k.x) <= level + plane.room;
  }
  const bool turns = plane.frame == Frame::crossed || plane.frame == Frame::rim;
  const bool stands = !(body.spin > 0) && !turns && !((of_a ? b_ : a_).spin > 0);
  if (!rigid && !stands) return false;
  const Vec3 n = of_a ? plane.n : Vec3(-plane.n);
  const double level = of_a ? plane.level + plane.n.dot(b_.k.x - a_.k.x) : -plane.level;
  return -extentAlong(p, -n) - p.piece->radius >= level - plane.room;
}

bool PersistentPlanes::keepApart(int piece_a, int piece_b) const {
  return std::ranges::any_of(planes_, [&](const Plane& plane) {
    return staysBeyond(plane, true, piece_a) && staysBeyond(plane, false, piece_b);
  });
}

PersistentPlanes::Approach PersistentPlanes::approachOf(const Follower& f, const Plane& plane, const Lying& p, const Placed& a,
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
  const bool on_a = plane.frame == Frame::body_a, on_b = plane.frame == Frame::body_b;
  if (const Placed& with = on_a ? a : b; (on_a || on_b) && !(with.spin > 0)) {  // only what is along its normal counts
    out.bend = std::abs(p.n.dot(body.acceleration - with.acceleration)) + body.variation + with.variation +
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

PersistentPlanes::Reach PersistentPlanes::reachAt(const PairMotion& pair, double t, double until, int steps) const {
  if (steps > kMostPlaneSteps)
    throw NotComputable("it takes more than " + std::to_string(kMostPlaneSteps) + " steps: they move along each other too closely");
  if (pair.work) pair.work->step();
  pair.arc_a.extendTo(t);
  pair.arc_b.extendTo(t);
  const Placed a(*a_.solid, pair.arc_a, t), b(*b_.solid, pair.arc_b, t);
  const double tolerance = touchTolerance(a, b), spin = a.spin + b.spin;
  Reach reach{until - t};
  if (spin > 0) reach.step = std::min(reach.step, 0.5 / spin);
  reach.apart = reach.step;
  const auto look = [&](const Approach& to, bool is_rim, const Plane& plane) {
    const bool there = to.gap <= tolerance;
    if (there && to.rate < -kStill * to.speed) {
      reach.touches = true;
      reach.through = reach.through || to.gap >= -plane.room;
      reach.broken = reach.broken || (to.gap < -plane.room && plane.held.empty());
      reach.step = std::min(reach.step, timeTo(tolerance, -to.rate, to.bend));
      return;
    }
    const double room = std::max(to.gap, 0.0) + tolerance * (there ? 1 : 0);
    const double within = reach.glides ? reach.apart : reach.step;
    const double step = is_rim ? to.rim.timeTo(room, to.rate + to.rim.belowRate(), to.bend, within)
                               : timeTo(room, -to.rate, to.bend);
    reach.step = std::min(reach.step, step);
    if (to.gap <= kNear * tolerance && std::abs(to.rate) <= kStill * to.speed) {
      reach.glides = true;
    } else {
      reach.apart = std::min(reach.apart, step);
    }
  };
  for (const Plane& plane : planes_) {
    if (plane.frame == Frame::rim && plane.side != 0) {
      Approach to = levelOfCap(plane, a, b);
      const bool swung = to.gap * plane.side < -plane.room && swingsPastCap(plane, a, b);
      const double side = swung ? -plane.side : plane.side;
      to.gap *= side, to.rate *= side;
      look(to, false, plane);
    }
    const std::optional<Lying> p = lie(plane, a, b);
    if (!p) continue;
    reach.step = std::min(reach.step, p->holds_for), reach.apart = std::min(reach.apart, p->holds_for);
    for (const Follower& f : plane.followers) look(approachOf(f, plane, *p, a, b, reach.step), f.is_rim, plane);
  }
  return reach;
}

// For how long what lies next to a plane, and neither comes nor goes, stays there: of the longest step the part up to the first
// of some times at which something of it has come nearer by half of its distance, or by the tolerance of contact.
double PersistentPlanes::glidesFor(const PairMotion& pair, double t, double longest) const {
  struct Gliding {
    const Plane* plane;
    const Follower* follower;
    double gap;
  };
  const auto look = [&](double at, const auto& use) {
    pair.arc_a.extendTo(at);
    pair.arc_b.extendTo(at);
    const Placed a(*a_.solid, pair.arc_a, at), b(*b_.solid, pair.arc_b, at);
    const double tolerance = touchTolerance(a, b);
    const auto gapOf = [&](const Plane& plane, const Follower& f) {
      const std::optional<Lying> p = lie(plane, a, b);
      return p ? approachOf(f, plane, *p, a, b, 0).gap : -std::numeric_limits<double>::infinity();
    };
    return use(gapOf, tolerance);
  };
  std::vector<Gliding> gliding;
  look(t, [&](const auto& gapOf, double tolerance) {
    for (const Plane& plane : planes_)
      for (const Follower& f : plane.followers)
        if (const double gap = gapOf(plane, f); gap <= kNear * tolerance) gliding.push_back({&plane, &f, gap});
    return true;
  });
  constexpr int kLooks = 12;
  for (int i = 1; i <= kLooks; ++i) {
    if (pair.work) pair.work->step();
    const bool stays = look(t + longest * i / kLooks, [&](const auto& gapOf, double tolerance) {
      return std::ranges::all_of(gliding, [&](const Gliding& g) {
        return gapOf(*g.plane, *g.follower) >= (g.gap > tolerance ? 0.5 * g.gap : -tolerance);
      });
    });
    if (!stays) return longest * (i - 1) / kLooks;
  }
  return longest;
}

}  // namespace carom::ode_bridge_detail
