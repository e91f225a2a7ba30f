// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/impact/impact.hpp"
#include "adjoint/simulate/contact_modes.hpp"
#include "adjoint/simulate/simulator.hpp"

// The law of impact, and bounces that are too low for it: those that part without speed instead (11.11), and those that
// are not reported impacts.

namespace carom::adjoint_detail {
namespace {

// A bounce that arrives from a lower height than this, as a share of the arm of the contact, is not a reported impact.
constexpr double kUncounted = 1e-6;
// Accelerations of contacts beyond so many times PairScales::mostAcceleration come of spins that no bounce is low at: far most
// often it tells at once.
constexpr double kFastestSpin = 10;

// What keeping contacts may change of a body's speeds, over the fastest approach.
constexpr double kMostPulled = 100;

bool isTilted(const Contact& c) { return c.tilt_a >= 0 || c.tilt_b >= 0; }

}  // namespace

void Simulator::solveLaw() {
  Event& event = draft_.event;
  const auto solve = [&] {
    try {
      solveImpact(event, *motion_.models, draft_.after);
    } catch (const NotComputable& error) {
      giveUp("impact", event.contacts[0].a, event.contacts[0].b, event.time, error);
    }
  };
  solve();
  std::vector<std::size_t> loose;  // contacts that are not to be kept
  while (contactsLast() && !leavesFast()) {
    std::vector<std::size_t> kept;
    if (!captureLow(loose, kept)) {
      if (!settlesFlat()) break;
      loose.clear();  // contacts have other places now
    }
    const std::vector<State> before = kept.empty() ? std::vector<State>() : draft_.after;
    solve();
    if (kept.empty() || !pullsTooMuch(before)) continue;
    for (const std::size_t k : kept) event.contacts[k].kept = false;
    loose.insert(loose.end(), kept.begin(), kept.end());
    solve();
  }
  event.settles_at.reset();
  if (event.contacts[0].captured) event.settles_at = settlesAt(motion_, event, draft_.after);
}

State Simulator::stateAfter(int body) const {
  if (const Participant* p = draft_.event.find(body)) return draft_.after[static_cast<std::size_t>(p - draft_.event.participants.data())];
  const Arc& arc = motion_.world_lines[index(body)].arcs.back();
  return arc.trajectory().ride() || drivesContacts(motion_, body) ? arc.stateAt(draft_.event.time) : arc.startState();
}

// d^2(gap)/dt^2 after the event, while contacts with fixed and kinematic bodies that part without speed stay closed.
double Simulator::accelerationOf(const Contact& contact) const {
  const auto sideOf = [&](int body) -> ContactSide {
    if (!(*motion_.models)[index(body)].moving) return {stateAfter(body), std::nullopt};
    if (!isMoved(body)) return givenSide(motion_, body, draft_.event.time);
    if (const auto acceleration = componentAcceleration(body)) return {stateAfter(body), acceleration};
    std::vector<const Contact*> closed;
    for (const Contact& c : draft_.event.contacts)
      if (c.lasts && (c.a == body || c.b == body) && !isMoved(c.a == body ? c.b : c.a))
        closed.push_back(&c);
    return {stateAfter(body), pressedAcceleration(motion_, body, stateAfter(body), closed, draft_.event.time)};
  };
  return gapAcceleration(motion_, contact, sideOf(contact.a), sideOf(contact.b));
}

// What no contact is faster than if it is to be low, and if it is not to count: squares of speeds, m^2/s^2.
void Simulator::setSpeedsOfContact() {
  lowest_speed_ = 2 * motion_.lowest_bounce * kFastestSpin * scales_.mostAcceleration();
  counted_speed_ = contactsLast() ? 2.1 * kUncounted * scales_.largest() * scales_.mostAcceleration() : 0;
}

// A lone contact leaves far too fast to be low: most events are that.
bool Simulator::leavesFast() const {
  const Contact& c = draft_.event.contacts[0];
  if (draft_.event.contacts.size() > 1 || isTilted(c)) return false;
  const double leaves = c.pair.elasticity * c.approach;
  return leaves * leaves > 2 * lowest_speed_;  // twice, for rounding
}

// Whether contacts that are kept change a body by far more than the speeds of the event: those of normals that differ by next to
// nothing fix what slides along them.
bool Simulator::pullsTooMuch(const std::vector<State>& before) const {
  const Event& event = draft_.event;
  double fastest = std::sqrt(2 * motion_.lowest_bounce * scene_.gravity.norm());
  for (const Contact& c : event.contacts)
    if (!c.held) fastest = std::max(fastest, std::abs(c.approach));
  for (std::size_t i = 0; i < before.size(); ++i) {
    const int body = event.participants[i].body;
    const State &was = before[i], &now = draft_.after[i];
    const BodyModel& model = (*motion_.models)[index(body)];
    const Vec3 turned = model.inverseInertiaWorld(now.q.toRotationMatrix()) * (now.L - was.L);
    if ((now.v - was.v).norm() + scales_.radius(body) * turned.norm() > kMostPulled * fastest) return true;
  }
  return false;
}

// Contacts that leave so slowly that they would be back from less than the lowest bounce part without speed instead
// (11.11); true where there are more of them than before. `kept`: those of them that did not approach.
bool Simulator::captureLow(const std::vector<std::size_t>& loose, std::vector<std::size_t>& kept) {
  Event& event = draft_.event;
  bool more = false;
  for (std::size_t k = 0; k < event.contacts.size(); ++k) {
    Contact& c = event.contacts[k];
    // one among others that approaches by rounding alone may have been captured without an impulse that closes it
    const bool closes_nothing = c.captured && !c.lasts && !(c.approach < -scaleOf(c.a, c.b, event.time).neither());
    if (c.lasts || c.kept || (c.captured && !closes_nothing)) continue;
    double leaves = 0;
    for (int body : {c.a, c.b}) {
      if (!event.find(body)) continue;
      const Kinematics now = arcOf(body).kinematicsOf(stateAfter(body));
      leaves += (body == c.a ? 1 : -1) * c.at.normal.dot(now.v + now.w.cross(c.at.point - now.x));
    }
    if (!(leaves * leaves < lowest_speed_)) continue;
    const double alpha = accelerationOf(c);
    if (!(alpha < 0 && leaves * leaves < -2 * motion_.lowest_bounce * alpha)) continue;
    const bool keeps = c.held || closes_nothing || !(c.approach < 0);
    if (keeps && std::ranges::find(loose, k) != loose.end()) continue;
    more = true;
    if (keeps) {
      c.kept = true;
      kept.push_back(k);
      continue;
    }
    c.captured = true;
    c.pair.elasticity = 0;
  }
  return more;
}

// Whether a contact arrives from high enough to be a reported impact.
bool Simulator::isCounted(const Contact& c, const State& a, const State& b) const {
  if (!contactsLast()) return true;
  if (c.approach * c.approach > counted_speed_) return true;
  double reach = 0;
  for (const auto& [body, s] : {std::pair{c.a, &a}, std::pair{c.b, &b}})
    if (isMoved(body)) reach = std::max(reach, (c.at.point - s->x).norm());
  const double height = kUncounted * reach;
  const double time = draft_.event.time;
  const double alpha = gapAcceleration(motion_, c, freeSide(motion_, c.a, a, time), freeSide(motion_, c.b, b, time));
  return !(alpha < 0 && c.approach * c.approach < -2 * height * alpha);
}

}  // namespace carom::adjoint_detail
