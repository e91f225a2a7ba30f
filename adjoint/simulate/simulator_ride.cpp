// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/constrained/ride_path.hpp"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/motion/guard.hpp"
#include "adjoint/simulate/contact_modes.hpp"
#include "adjoint/simulate/simulator.hpp"

// Components that something carries (docs/equations.md, 11.33): for how long.

namespace carom::adjoint_detail {
namespace {

// What ends within this share of the time of a fall by a body's radius ends now.
constexpr double kSoon = 1e-9;

}  // namespace

// How long bodies rest on what moves: while it holds them, and they are on its face. Nothing where that cannot be told.
std::optional<Ride> Simulator::rideOf(const SupportedComponent& component, const std::vector<const Contact*>& on) const {
  const double now = draft_.event.time;
  Ride ride{*component.carried().by, component.heldUntil(on, motion_.duration)};
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get());
  if (!ride.carrier.isBelt() || !bodies) return ride;
  const Vec3 v = ride.carrier.at(now).v;
  for (const Contact* c : on) {
    if (c->a != ride.carrier.body && c->b != ride.carrier.body) continue;
    const auto pose = [&](int body) { return shapePose(motion_, body, stateAfter(body)); };
    const Pose A = pose(c->a), B = pose(c->b);
    for (const FeatureLimit& limit : bodies->limits(c->a, c->b, c->features, A, B)) {
      if (limit.body != ride.carrier.body || limit.point_weight.isZero(0)) continue;
      if (limit.radius > 0) return std::nullopt;
      const Pose& of = limit.body == c->a ? A : B;
      const Vec3 weight = of.R * limit.point_weight;
      const double room = weight.dot(c->at.point - of.x - of.R * limit.border), rate = weight.dot(v);
      if (const double end = now - room / rate; rate < 0 && end < ride.until) ride.until = end, ride.leaves = true;
    }
  }
  return ride;
}

// Whether two bodies keep their places to each other: at rest, or carried by one carrier.
bool Simulator::goTogether(int a, int b) {
  const auto stays = [](const Arc& arc) { return arc.stays() || arc.kind() == ArcKind::rest; };
  const Arc &arc_a = pathOf(a), &arc_b = pathOf(b);
  if (stays(arc_a) && stays(arc_b)) return true;
  const auto carrierOf = [](const Arc& arc, int body) {
    const RidePath* ride = arc.trajectory().ride();
    return ride ? ride->carrier().body : body;
  };
  const RidePath *of_a = arc_a.trajectory().ride(), *of_b = arc_b.trajectory().ride();
  if (!of_a && !of_b) return false;
  const bool belt = (of_a ? of_a : of_b)->carrier().isBelt();
  return carrierOf(arc_a, a) == carrierOf(arc_b, b) && (!belt || (of_a && of_b));
}

// The motion ends where a carrier no longer holds what it carries; false where it does, as that has changed in the meantime.
bool Simulator::endsRide(int body) {
  const double now = contact_states_[index(body)].transition;
  beginDraft(now);
  const std::vector<int> part = supportsAround(body);
  const std::vector<Contact> held = heldOf(part);
  const SupportedComponent component = componentOf(part, held);
  std::optional<Ride> ride;
  if (component.restOn(pointersTo(held)).holds) ride = rideOf(component, pointersTo(held));
  if (ride && ride->until > now + kSoon * std::sqrt(scales_.radius(body) / scene_.gravity.norm())) {
    for (const int member : part) contact_states_[index(member)].transition = ride->until;
    for (const int member : part) predictBody(member, now);
    return false;
  }
  const auto joins = std::ranges::find_if(held, [&](const Contact& c) { return joinsMoved(c); });
  const std::string& carrier = scene_.bodies[index(arcOf(body).trajectory().ride()->carrier().body)].name;
  const bool several = joins != held.end();
  const std::string rests = several ? namesOf(joins->a, joins->b) + " rest on each other" : "'" + scene_.bodies[index(body)].name + "' rests";
  const char* const leaves = several ? " s, where they come to its end" : " s, where it comes to the end of that";
  const char* const slips = several ? " s, where it no longer holds them" : " s, where that no longer holds it";
  finish(MotionStatus::unresolved_contact, now,
         textOf(10, rests, several ? ", on '" : " on '", carrier, "', until t = ", now, ride && ride->leaves ? leaves : slips, ", after ", eventsSoFar(),
                "; motion on bodies that can move is not modelled yet, so the motion ends there"));
  return true;
}

}  // namespace carom::adjoint_detail
