// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "ode_bridge/persistent_planes.hpp"
#include "ode_bridge/touching.hpp"

// How the planes of held contacts move.

namespace carom::ode_bridge_detail {
namespace {

// The sine of the angle between the normal of a contact and that of a cap, above which the cap is not what is touched.
constexpr double kOffCap = 1e-3;

}  // namespace

// With D = n.(e_a x e_b), where n.e_a and n.e_b stay what they are (0, but of a cone): n.dn = 0, e_a.dn = -n.de_a and
// e_b.dn = -n.de_b. D^2 changes by no more than 4 times the spin, of edges that do not taper D itself by the spin.
std::optional<PersistentPlanes::Lying> PersistentPlanes::crossing(const Plane& plane, const Placed& a, const Placed& b) const {
  const double spin = a.spin + b.spin;
  const Vec3 ea = a.k.R * plane.edge_a.direction, eb = b.k.R * plane.edge_b.direction;
  Lying p;
  p.n = contactAt(a, b, plane.held.front()).normal;
  const double D = p.n.dot(ea.cross(eb)), sine = std::abs(D);
  if (!(sine > 0)) return std::nullopt;
  p.dn = -(p.n.dot(a.k.w.cross(ea)) * eb.cross(p.n) + p.n.dot(b.k.w.cross(eb)) * p.n.cross(ea)) / D;
  p.n1 = spin / (0.5 * sine), p.n2 = (spin * spin + a.spin_rate + b.spin_rate) / (0.5 * sine) + 3 * p.n1 * p.n1;
  const bool tapers = plane.edge_a.apex > 0 || plane.edge_b.apex > 0;
  if (spin > 0) p.holds_for = tapers ? 0.1875 * sine * sine / spin : 0.5 * sine / spin;
  p.point = b.world(plane.edge_b.point + plane.edge_b.apex * plane.edge_b.direction);
  p.beyond = plane.edge_b.radius;
  p.with = &b;
  return p;
}

// What a rim is held at, the line e of an edge or a side: its cap of normal d comes down on it where d.e + tau = 0, tau the
// sine of the slope of a cone's side (of other lines 0).
PersistentPlanes::Approach PersistentPlanes::levelOfCap(const Plane& plane, const Placed& a, const Placed& b) {
  const bool of_a = isRimOf(plane.edge_a);
  const Feature &rim = of_a ? plane.edge_a : plane.edge_b, &line = of_a ? plane.edge_b : plane.edge_a;
  const Placed &disc = of_a ? a : b, &other = of_a ? b : a;
  const Vec3 d = disc.k.R * rim.direction, e = other.k.R * line.direction;
  const double across = 2 * rim.rim, spin = a.spin + b.spin;
  const double slope = line.apex > 0 ? line.rim / std::sqrt(line.rim * line.rim + 4 * line.apex * line.apex) : 0;
  Approach out;
  out.gap = across * (d.dot(e) + slope);
  out.rate = across * (disc.k.w - other.k.w).dot(d.cross(e));
  out.bend = across * (spin * spin + a.spin_rate + b.spin_rate);
  out.speed = across * spin;
  return out;
}

// Where the cap lies on the line, the side on which it can lift from there: with the way u out of the rim at the contact and
// the normal d cos b + u sin b, 0 <= b, what is across the line is -(u.e) sin b.
double PersistentPlanes::sideOfCap(const Plane& plane) const {
  const bool of_a = isRimOf(plane.edge_a);
  const Feature &rim = of_a ? plane.edge_a : plane.edge_b, &line = of_a ? plane.edge_b : plane.edge_a;
  const Placed &disc = of_a ? a_ : b_, &other = of_a ? b_ : a_;
  const double level = levelOfCap(plane, a_, b_).gap;
  if (std::abs(level) > plane.room) return level < 0 ? -1 : 1;
  const Vec3 e = other.k.R * line.direction, d = disc.k.R * rim.direction;
  const Vec3 out = contactAt(a_, b_, plane.held.front()).point - disc.world(rim.point);
  return (out - d.dot(out) * d).dot(e) > 0 ? -1 : 1;
}

// Whether the line is level with the cap as it goes along the rim, u.e = 0 in place of b = 0: then it has swung to the other side,
// and the cap has not come down on it.
bool PersistentPlanes::swingsPastCap(const Plane& plane, const Placed& a, const Placed& b) {
  const bool of_a = isRimOf(plane.edge_a);
  const Vec3 d = (of_a ? a : b).k.R * (of_a ? plane.edge_a : plane.edge_b).direction;
  return contactAt(a, b, plane.held.front()).normal.cross(d).norm() > kOffCap;
}

std::optional<PersistentPlanes::Lying> PersistentPlanes::lie(const Plane& plane, const Placed& a, const Placed& b) const {
  Lying p;
  if (plane.frame == Frame::rim) return std::nullopt;
  if (plane.frame == Frame::crossed) {
    const std::optional<Lying> crossed = crossing(plane, a, b);
    if (!crossed) return std::nullopt;
    p = *crossed;
  } else {
    p.with = plane.frame == Frame::body_a ? &a : &b;
    p.n = p.with->k.R * plane.normal, p.dn = p.with->k.w.cross(p.n);
    p.n1 = p.with->spin, p.n2 = p.with->spin * p.with->spin + p.with->spin_rate;
    p.point = p.with->world(plane.point);
  }
  p.arm = p.point - p.with->k.x;
  p.velocity = p.with->k.v + p.with->k.w.cross(p.arm);
  return p;
}

}  // namespace carom::ode_bridge_detail
