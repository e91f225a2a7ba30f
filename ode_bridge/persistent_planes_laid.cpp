// SPDX-License-Identifier: MIT
// Which planes the contacts of two bodies lie in, and what these go with.

#include <algorithm>
#include <cmath>

#include "ode_bridge/affine_span.hpp"
#include "ode_bridge/persistent_planes.hpp"
#include "ode_bridge/touching.hpp"

namespace carom::ode_bridge_detail {
namespace {

// What is within so many tolerances of contact of a held plane lies in it.
constexpr double kInPlane = 10;

// The points of a feature that lie in the plane of its contact, in the axes of its solid; of an edge its ends, or the contact.
template <class Add>
void addPointsInPlane(const Solid& solid, Family family, int index, const Vec3& contact, bool with_ends, const Add& add) {
  const auto at = static_cast<std::size_t>(index);
  switch (family) {
    case Family::vertex:
      add(solid.vertices[at].point);
      return;
    case Family::edge: {
      const SolidEdge& edge = solid.edges[at];
      if (isSwept(edge) || !with_ends) {
        add(contact);
        return;
      }
      for (const double end : {-1.0, 1.0}) add(edge.point + end * edge.half_length * edge.direction);
      return;
    }
    case Family::face: {
      const SolidFace& face = solid.faces[at];
      const Vec3 u = face.direction.unitOrthogonal();
      add(face.point), add(face.point + u), add(face.point + face.direction.cross(u));
      return;
    }
    case Family::rim:
      if (contact.allFinite()) add(contact);  // one that lies flat has no point of its own
      return;
  }
}

}  // namespace

// A plane, and what is known to lie in it: of each body, in the axes of its solid.
struct PersistentPlanes::Laid {
  struct Member {
    Through contact;
    std::optional<FeaturePair> own;
  };
  Plane plane;
  std::vector<Member> members;
  AffineSpan of_a, of_b;
};

PersistentPlanes::PersistentPlanes(const Placed& a, const Placed& b, std::span<const FeaturePair> held,
                       std::span<const ConstrainedElsewhere> elsewhere, bool moves_a)
    : a_(a), b_(b), moves_a_(moves_a) {
  std::vector<Laid> laid;
  for (const FeaturePair& f : held) layThrough(throughOwn(f), &f, laid);
  for (const ConstrainedElsewhere& h : elsewhere) layThrough(through(h), nullptr, laid);
  std::vector<Laid> apart;
  for (Laid& each : laid)
    for (Laid& part : laidApart(std::move(each))) apart.push_back(std::move(part));
  for (Laid& each : apart) {
    fixTo(each);
    const bool goes_with_one = each.plane.frame == Frame::body_a || each.plane.frame == Frame::body_b;
    if (each.plane.held.empty() && !goes_with_one) continue;  // an edge of another body tells nothing of these
    planes_.push_back(std::move(each.plane));
    Plane& kept = planes_.back();
    addFollowers(kept);
    const auto inPlane = [&](const Follower& f) {
      const Placed& body = f.of_a ? a_ : b_;
      const AffineSpan& span = f.of_a ? each.of_a : each.of_b;
      if (!span.contains(f.feature.point)) return false;
      if (!f.is_rim) return true;
      // about a line through its centre it can tilt
      return span.isPlane() && (body.k.R * f.feature.direction).cross(kept.n).norm() <= kSamePlane;
    };
    std::erase_if(kept.followers, inPlane);
    if (kept.held.empty() && isBroken(kept)) planes_.pop_back();
  }
}

PersistentPlanes::Through PersistentPlanes::throughOwn(const FeaturePair& f) const {
  const auto kind = static_cast<GapKind>(f.kind);
  return {contactAt(a_, b_, f), {&a_, familyOfFirst(kind), f.a}, {&b_, familyOfSecond(kind), f.b}};
}

PersistentPlanes::Through PersistentPlanes::through(const ConstrainedElsewhere& h) const {
  const auto kind = static_cast<GapKind>(h.features.kind);
  const Placed& moving = moves_a_ ? a_ : b_;
  const Placed &first = h.moving_first ? moving : *h.with, &second = h.moving_first ? *h.with : moving;
  Through out{contactAt(first, second, h.features), {&first, familyOfFirst(kind), h.features.a},
              {&second, familyOfSecond(kind), h.features.b}};
  if (h.moving_first != moves_a_) {
    std::swap(out.of_a, out.of_b);
    out.at.normal = -out.at.normal;
  }
  return out;
}

// Adds a contact to the plane that it lies in; that is a new one where it lies in none of the others.
void PersistentPlanes::layThrough(const Through& contact, const FeaturePair* own, std::vector<Laid>& laid) const {
  const ContactPoint& c = contact.at;
  if (!c.normal.allFinite() || !std::isfinite(c.gap)) return;
  const auto levelOf = [&] {
    for (const Side* side : {&contact.of_b, &contact.of_a})
      if (side->family == Family::face)
        return c.normal.dot(side->body->world(side->body->solid->faces[static_cast<std::size_t>(side->index)].point) - b_.k.x);
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
  same->members.push_back({contact, own ? std::optional(*own) : std::nullopt});
}

// Edges that cross have the plane through both, which turns with them: it stays one with that of a face, or of other edges,
// only where three points of contact, not on a line, hold it there. Of edges that cross one edge it is one, too.
std::vector<PersistentPlanes::Laid> PersistentPlanes::laidApart(Laid laid) const {
  const auto crosses = [](const Laid::Member& m) { return m.contact.crosses(); };
  AffineSpan held(laid.of_a);
  for (const Laid::Member& m : laid.members)
    if (m.contact.at.point.allFinite()) held.add(a_.k.R.transpose() * (m.contact.at.point - a_.k.x));
  const auto ofOne = [&](const auto& side) {
    return std::ranges::all_of(laid.members, [&](const Laid::Member& m) {
      const Side &of = m.contact.*side, &first = laid.members.front().contact.*side;
      return crosses(m) && of.family == first.family && of.index == first.index;
    });
  };
  const bool is_one = held.isPlane() || ofOne(&Through::of_a) || ofOne(&Through::of_b);
  const bool only_cross = std::ranges::all_of(laid.members, crosses);
  std::vector<Laid> out;
  if (is_one || !only_cross) {
    span(laid, is_one);
    out.push_back(std::move(laid));
    return out;
  }
  for (const Laid::Member& m : laid.members) {
    Laid& part = out.emplace_back(laid);
    part.members = {m};
    span(part, true);
  }
  return out;
}

void PersistentPlanes::span(Laid& laid, bool with_ends) const {
  Plane& plane = laid.plane;
  for (const Laid::Member& m : laid.members) {
    const Through& contact = m.contact;
    if (m.own) {
      plane.held.push_back(*m.own);
      if (contact.crosses() && plane.held.size() == 1)
        plane.edge_a = a_.solid->feature(contact.of_a.family, contact.of_a.index),
        plane.edge_b = b_.solid->feature(contact.of_b.family, contact.of_b.index);
    } else {
      const Side &moving = moves_a_ ? contact.of_a : contact.of_b, &fixed = moves_a_ ? contact.of_b : contact.of_a;
      plane.held_elsewhere.push_back({moving.family, moving.index, fixed.family == Family::face});
    }
    const auto addTo = [&](const Side& side, const Placed& body, AffineSpan& of) {
      addPointsInPlane(*side.body->solid, side.family, side.index,
                       side.body->k.R.transpose() * (contact.at.point - side.body->k.x), with_ends, [&](const Vec3& p) {
                         of.add(side.body == &body ? p : Vec3(body.k.R.transpose() * (side.body->world(p) - body.k.x)));
                       });
    };
    addTo(contact.of_a, a_, laid.of_a);
    addTo(contact.of_b, b_, laid.of_b);
  }
}

// Finds what the plane goes with.
void PersistentPlanes::fixTo(Laid& laid) const {
  Plane& plane = laid.plane;
  const auto goesWith = [&](Frame frame, const Placed& body, const AffineSpan& span) {
    plane.frame = frame;
    plane.normal = body.k.R.transpose() * plane.n;
    plane.point = span.origin();
  };
  const bool of_a = laid.of_a.isPlane();
  if (laid.of_b.isPlane() && !(of_a && b_.spin > 0 && !(a_.spin > 0))) {  // rather with what does not turn
    goesWith(Frame::body_b, b_, laid.of_b);
  } else if (of_a) {
    goesWith(Frame::body_a, a_, laid.of_a);
  } else if (isRimOf(plane.edge_a) != isRimOf(plane.edge_b)) {
    plane.frame = Frame::rim;
    if (plane.held.size() == 1) plane.side = sideOfCap(plane);
  }
}

}  // namespace carom::ode_bridge_detail
