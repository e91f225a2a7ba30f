// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/constrained/ride_path.hpp"
#include "adjoint/motion/body_geometry.h"
#include "adjoint/motion/guard.hpp"
#include "adjoint/simulate/contact_modes.hpp"
#include "adjoint/simulate/ride_border.hpp"
#include "adjoint/simulate/simulator.hpp"

// Components that something carries (docs/equations.md, 11.33): for how long, and what comes then.

namespace carom::adjoint_detail {
namespace {

// What ends within this share of the time of a fall by a body's radius ends now.
constexpr double kSoon = 1e-9;

}  // namespace

// How long bodies rest on what moves: while it holds them, and they are on its faces. Nothing where that cannot be told.
std::optional<Ride> Simulator::rideOf(const SupportedComponent& component, const std::vector<const Contact*>& on) const {
  const double now = draft_.event.time;
  Ride ride{*component.carried().by, component.heldUntil(on, motion_.duration), {}, -1};
  const auto* bodies = dynamic_cast<const BodyGeometry*>(motion_.geometry.get());
  if (!ride.carrier.isBelt()) return ride;
  if (!bodies) return std::nullopt;
  for (const Carrier::Part& part : ride.carrier.parts) {
    if (!part.support.has_belt) continue;
    for (const Contact* c : on) {
      if (c->a != part.body && c->b != part.body) continue;
      const auto pose = [&](int body) { return shapePose(motion_, body, body == part.body ? arc_[index(body)]->stateAt(now) : stateAfter(body)); };
      const std::vector<FeatureLimit> limits = bodies->limits(c->a, c->b, c->features, pose(c->a), pose(c->b));
      for (std::size_t k = 0; k < limits.size(); ++k) {
        if (limits[k].body != part.body || limits[k].point_weight.isZero(0)) continue;
        const double end = timeAtBorder(ride.carrier, part, limits[k], c->at.point);
        if (end < ride.until) ride.until = end, ride.leaving = *c, ride.limit = static_cast<int>(k);
      }
    }
  }
  return ride;
}

// Whether two bodies keep their places to each other: at rest, or carried by one carrier.
bool Simulator::goTogether(int a, int b) {
  const auto stays = [](const Arc& arc) { return arc.stays() || arc.kind() == ArcKind::rest; };
  const Arc &arc_a = pathOf(a), &arc_b = pathOf(b);
  if (stays(arc_a) && stays(arc_b)) return true;
  const RidePath *of_a = arc_a.trajectory().ride(), *of_b = arc_b.trajectory().ride();
  if (of_a && of_b)
    return std::ranges::any_of(of_a->carrier().parts, [&](const Carrier::Part& part) { return of_b->carrier().has(part.body); });
  if (!of_a && !of_b) return false;
  const RidePath& ride = of_a ? *of_a : *of_b;
  return !ride.carrier().isBelt() && ride.carrier().has(of_a ? b : a);
}

// Where the time of a ride has come: it goes on, bodies go on otherwise, as the draft says, or the motion ends.
Simulator::RideEnd Simulator::resolveRide(int body) {
  const double now = contact_states_[index(body)].transition;
  beginDraft(now);
  const std::vector<int> part = supportsAround(body);
  const std::vector<Contact> held = heldOf(part);
  const SupportedComponent component = componentOf(part, held);
  std::optional<Ride> ride;
  if (component.restOn(component.closed()).holds) ride = rideOf(component, component.closed());
  if (ride && ride->until > now + kSoon * std::sqrt(scales_.radius(body) / scene_.gravity.norm())) {
    for (const int member : part) contact_states_[index(member)].transition = ride->until;
    for (const int member : part) predictBody(member, now);
    return RideEnd::goes_on;
  }
  const auto joins = std::ranges::find_if(held, [&](const Contact& c) { return joinsMoved(c); });
  const Contact pair = *joins;  // what is left alone on a carrier has a path of its own
  const bool leaves = ride && ride->leaving;
  if (leaves) {
    leaveCarrier(*ride, part, held);
    if (draft_.beyond.empty()) return RideEnd::otherwise;
  }
  const std::size_t why = draft_.beyond.rfind("; ");
  const std::string reason = leaves && why != std::string::npos ? draft_.beyond.substr(why) : "; they would move on each other, so the motion ends there";
  const std::string carrier = adjoint_detail::namesOf(motion_, arcOf(body).trajectory().ride()->carrier());
  for (const int member : bodies_) in_draft_[index(member)] = -1;
  finish(MotionStatus::unresolved_contact, now,
         textOf(10, namesOf(pair.a, pair.b), " rest on each other, on ", carrier, ", until t = ", now,
                leaves ? " s, where they come to its end" : " s, where it no longer holds them", ", after ", eventsSoFar(), reason));
  return RideEnd::ends;
}

// A contact of bodies that ride comes to the end of a belt: they rest on what goes on there, or move.
void Simulator::leaveCarrier(const Ride& ride, const std::vector<int>& part, const std::vector<Contact>& held) {
  Event& event = draft_.event;
  event.kind = EventKind::transition;
  event.cause = TransitionCause::leaves;
  event.border = ride.limit;
  draft_.woken = part;
  addHeld(*ride.leaving, false);
  for (const Contact& h : held)
    if (joinsMoved(h)) addHeld(h, true);
  for (const int member : part) {
    BodyContactState on_carrier = contact_states_[index(member)];
    std::erase_if(on_carrier.held, [&](const Contact& h) { return joinsMoved(h); });
    if (on_carrier.held.empty()) continue;
    for (const Contact& c : contactsBeyond(on_carrier, member, event.time)) {
      if (joinsMoved(c) || c.approach > strikingSpeed(c) || inDraft(c.a, c.b, c.features)) continue;
      addHeld(c, true).held = std::ranges::any_of(held, [&](const Contact& h) { return isSameContact(h, c); });
    }
  }
  dropDoubles(1);
  goOnOtherwise(part);
  if (draft_.beyond.empty()) predictDraft();
}

}  // namespace carom::adjoint_detail
