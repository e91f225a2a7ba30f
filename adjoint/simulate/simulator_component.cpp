// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/motion/guard.hpp"
#include "adjoint/numeric/union_find.hpp"
#include "adjoint/simulate/path_arc.hpp"
#include "adjoint/simulate/simulator.hpp"
#include "adjoint/simulate/supported_component.hpp"

// Bodies that lie on each other: components of those that contacts press together rest where all of them can
// (docs/equations.md, 11.14).

namespace carom::adjoint_detail {
namespace {

using Member = SupportedComponent::Member;

// The parts of `bodies`, in increasing order, that these contacts connect, each in increasing order.
std::vector<std::vector<int>> connectedBy(const std::vector<int>& bodies, const std::vector<const Contact*>& contacts) {
  UnionFind sets(bodies.size());
  for (const Contact* c : contacts)
    if (const int a = placeIn(bodies, c->a), b = placeIn(bodies, c->b); a >= 0 && b >= 0)
      sets.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  std::vector<std::vector<int>> parts(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) parts[sets.find(i)].push_back(bodies[i]);
  std::erase_if(parts, [](const std::vector<int>& part) { return part.empty(); });
  std::ranges::sort(parts);
  return parts;
}

bool has(const std::vector<int>& bodies, int body) { return std::ranges::binary_search(bodies, body); }
bool isOf(const std::vector<int>& bodies, const Contact& c) { return has(bodies, c.a) || has(bodies, c.b); }

}  // namespace

// Whether a body rests on others, or under them, and takes part in the event without being moved.
bool Simulator::isSupport(int body) const {
  if (!any_lasted_ || arc_[index(body)]->trajectory().group() || std::ranges::find(draft_.woken, body) != draft_.woken.end()) return false;
  return std::ranges::any_of(contact_states_[index(body)].held, [&](const Contact& c) { return joinsMoved(c); });
}

// All supports that a support is connected with, itself among them.
std::vector<int> Simulator::supportsAround(int body) const {
  std::vector<int> found = {body};
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const Contact& c : contact_states_[index(found[i])].held)
      if (const int other = c.a == found[i] ? c.b : c.a;
          isMoved(other) && isSupport(other) && std::ranges::find(found, other) == found.end())
        found.push_back(other);
  std::ranges::sort(found);
  return found;
}

// What holds supports, but for what the event moves.
std::vector<Contact> Simulator::heldOf(const std::vector<int>& supports) const {
  std::vector<Contact> held;
  for (int body : supports)
    for (const Contact& c : contact_states_[index(body)].held) {
      const int other = c.a == body ? c.b : c.a;
      if (isMoved(other) && !isSupport(other)) continue;
      if (other < body && has(supports, other)) continue;  // it is listed once
      held.push_back(c);
      if (arc_[index(body)]->trajectory().ride()) held.back().at = contactNow(c);
    }
  return held;
}

// A contact of what rests, as it is at the event.
ContactPoint Simulator::contactNow(const Contact& c) const {
  const auto pose = [&](int body) { return shapePose(motion_, body, stateAfter(body)); };
  return motion_.geometry->contact(c.a, c.b, c.features, pose(c.a), pose(c.b));
}

SupportedComponent Simulator::componentOf(const std::vector<int>& bodies, const std::vector<Contact>& closed) const {
  std::vector<Member> members;
  for (int body : bodies) members.push_back({body, stateAfter(body)});
  return {motion_, std::move(members), pointersTo(closed), draft_.event.time};
}

// Whether an impulse is more than friction and what lies around can take: then what is struck is moved.
bool Simulator::wakesStruck() {
  bool more = false;
  std::vector<int> seen;
  for (const Participant& p : draft_.event.participants) {
    if (!p.stays || has(seen, p.body)) continue;
    const std::vector<int> part = supportsAround(p.body);
    seen.insert(seen.end(), part.begin(), part.end());
    std::ranges::sort(seen);
    std::vector<const Contact*> struck;
    double slow = std::numeric_limits<double>::infinity();
    for (const Contact& c : draft_.event.contacts)
      if (isOf(part, c) && c.impulse.norm() > 0) struck.push_back(&c);
    if (struck.empty()) continue;
    const std::vector<Contact> held = heldOf(part);
    const SupportedComponent component = componentOf(part, held);
    for (std::size_t i = 0; i < part.size(); ++i) slow = std::min(slow, leastSlip(scene_.gravity.norm(), component.reachOf(i)));
    if (component.holdImpulses(pointersTo(held), struck, slow)) continue;
    for (const Contact* c : struck)
      for (int body : {c->a, c->b})
        if (has(part, body)) draft_.woken.push_back(body), more = true;
  }
  return more;
}

bool Simulator::wakesUnheld() {
  draft_.woken.insert(draft_.woken.end(), draft_.unheld.begin(), draft_.unheld.end());
  return !draft_.unheld.empty();
}

// Participants that impulses can move, in increasing order; with supports also those that are connected with them.
std::vector<int> Simulator::movedBodies(bool with_supports) const {
  std::vector<int> moved;
  for (const Participant& p : draft_.event.participants) {
    if (!isMoved(p.body)) continue;
    if (!p.stays) moved.push_back(p.body);
    if (!p.stays || !with_supports || std::ranges::find(moved, p.body) != moved.end()) continue;
    const std::vector<int> part = supportsAround(p.body);
    moved.insert(moved.end(), part.begin(), part.end());
  }
  std::ranges::sort(moved);
  moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
  return moved;
}

// Contacts of these bodies that last, with each other and with what stays: those of the event, and those of supports before it.
std::vector<Contact> Simulator::lasting(const std::vector<int>& bodies) const {
  std::vector<Contact> closed;
  const auto stands = [&](int body) { return !isMoved(body) || has(bodies, body) || isSupport(body); };
  for (const Contact& c : draft_.event.contacts) {
    if (!c.lasts || !isOf(bodies, c) || !stands(c.a) || !stands(c.b)) continue;
    closed.push_back(c);
    closed.back().pair = builder_.pairOf(c.a, c.b);
  }
  std::vector<int> supports;
  std::ranges::copy_if(bodies, std::back_inserter(supports), [&](int body) { return isSupport(body); });
  for (Contact& c : heldOf(supports))
    if (std::ranges::none_of(closed, [&](const Contact& d) { return isSameContact(c, d); })) closed.push_back(std::move(c));
  dropFlatRims(closed);
  return closed;
}

// Parts of these bodies that contacts press together, and each of the others by itself.
std::vector<std::vector<int>> Simulator::pressedParts(const std::vector<int>& bodies, const std::vector<Contact>& closed) const {
  return connectedBy(bodies, componentOf(bodies, closed).pressed());
}

bool Simulator::standsStill(const SupportedComponent& component, bool opposed, double no_slip) const {
  for (std::size_t i = 0; i < component.members().size(); ++i) {
    const double reach = component.reachOf(i), least = leastSlip(scene_.gravity.norm(), reach);
    const double fastest = std::max(component.speedOf(i), reach * component.spinOf(i));
    if (!(fastest <= least || (opposed && fastest <= no_slip))) return false;
  }
  return true;
}

// A component at rest: on what presses without friction, or on all that is closed.
std::optional<RestingComponent> Simulator::restOf(const std::vector<int>& bodies, const std::vector<Contact>& closed,
                                                             double no_slip, bool on_all) const {
  const SupportedComponent component = componentOf(bodies, closed);
  if (!standsStill(component, true, no_slip)) return std::nullopt;
  const SupportedComponent::Rest rest = component.restOn(on_all ? component.closed() : component.pressed());
  if (!rest.holds || !standsStill(component, rest.opposed, no_slip)) return std::nullopt;
  RestingComponent found{component.members(), {}, rest.opposed, std::nullopt};
  if (component.carried().by) {
    found.ride = rideOf(component, on_all ? rest.bearing : component.pressed());
    if (!found.ride) return std::nullopt;
  }
  for (const Contact* c : on_all ? rest.bearing : component.pressed()) found.on.push_back(*c);
  return found;
}

// Contacts of these bodies with each other and with what impulses do not move.
std::vector<Contact> Simulator::within(const std::vector<int>& part, const std::vector<Contact>& all) const {
  std::vector<Contact> own;
  std::ranges::copy_if(all, std::back_inserter(own), [&](const Contact& c) {
    return isOf(part, c) && (has(part, c.a) || !isMoved(c.a)) && (has(part, c.b) || !isMoved(c.b));
  });
  return own;
}

// Which participants rest on others, or under them. Contacts that press bodies together of which some are moved are kept in mind,
// and supports that nothing holds any more.
void Simulator::chooseComponents() {
  const Event& event = draft_.event;
  draft_.resting.assign(bodies_.size(), {});
  draft_.grouped.assign(bodies_.size(), {});
  draft_.pressing.clear();
  draft_.unheld.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (event.participants[i].stays)
      draft_.contact_state[i].held = heldOf({bodies_[i]}), draft_.contact_state[i].transition = contact_states_[index(bodies_[i])].transition;
  const auto joins = [&](const Contact& c) { return c.lasts && joinsMoved(c); };
  if (draft_.woken.empty() && std::ranges::none_of(event.contacts, joins)) return;  // far most often
  const std::vector<int> bodies = movedBodies(true);
  const std::vector<Contact> all = lasting(bodies);
  for (const std::vector<int>& touching : connectedBy(bodies, pointersTo(all)))
    if (touching.size() > 1 || isSupport(touching.front())) chooseRest(touching, within(touching, all));
}

// Parts that contacts press together rest by themselves; or all that touches, where friction needs what nothing presses.
void Simulator::chooseRest(const std::vector<int>& touching, const std::vector<Contact>& closed) {
  const double no_slip = hintOf(closed).no_slip;
  std::vector<std::vector<int>> parts = pressedParts(touching, closed);
  std::erase_if(parts, [&](const std::vector<int>& part) { return part.size() == 1 && !isSupport(part.front()); });
  std::vector<std::optional<RestingComponent>> rests;
  for (const std::vector<int>& part : parts) rests.push_back(restOf(part, within(part, closed), no_slip));
  if (std::ranges::any_of(rests, [](const auto& rest) { return !rest; }))
    if (auto whole = restOf(touching, closed, no_slip, true)) return holdAtRest(*whole);
  const bool all_rest = std::ranges::all_of(rests, [](const auto& rest) { return rest.has_value(); });
  const bool closes = std::ranges::any_of(draft_.closing, [&](int body) { return has(touching, body); });
  if ((!all_rest || closes) && groups_) {
    std::ranges::copy_if(touching, std::back_inserter(draft_.unheld), [&](int body) { return isSupport(body); });
    if (draft_.unheld.empty()) joinGroups(touching, closed);
    return;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool alone = parts[i].size() == 1;
    if (rests[i] && !(alone && rests[i]->ride)) {
      holdAtRest(*rests[i]);
    } else if (alone) {  // also what is left alone on its carrier: it has a path of its own
      draft_.unheld.push_back(parts[i].front());
    } else {
      const std::vector<Contact> own = within(parts[i], closed);
      for (const Contact* c : componentOf(parts[i], own).pressed())
        if (joinsMoved(*c)) draft_.pressing.push_back(*c);
    }
  }
}

// The poses of what has come to rest close its gaps; what stays has more that holds it.
void Simulator::holdAtRest(RestingComponent& rest) {
  if (lieAlongEdges(pointersTo(rest.on), rest.on)) rest.opposed = false;  // a little aside it has another normal
  const auto comesToRest = [&](int body) { return isMoved(body) && !isSupport(body); };
  std::vector<Contact> on;
  std::ranges::copy_if(rest.on, std::back_inserter(on), [&](const Contact& c) { return comesToRest(c.a) || comesToRest(c.b); });
  std::erase_if(rest.members, [&](const Member& m) { return isSupport(m.body); });
  if (std::ranges::any_of(on, [](const Contact& c) { return !c.held; })) closeGaps(motion_, rest.members, on, draft_.event.time);
  for (const Member& m : rest.members) {
    RestingMember& member = draft_.resting[participantIn(m.body)].emplace(RestingMember{m.state, {}, rest.opposed, rest.ride});
    std::ranges::copy_if(on, std::back_inserter(member.held), [&](const Contact& c) { return c.a == m.body || c.b == m.body; });
  }
  for (const Contact& c : on)
    for (int body : {c.a, c.b})
      if (isMoved(body) && isSupport(body)) {
        BodyContactState& state = draft_.contact_state[participantIn(body)];
        state.held.push_back(c);
        if (rest.ride) state.transition = rest.ride->until;
      }
}

void Simulator::rest(std::size_t participant) {
  RestingMember& member = *draft_.resting[participant];
  const int body = bodies_[participant];
  if (member.ride) {
    draft_.contact_state[participant].transition = member.ride->until;
    return goOn(participant, rideArc(motion_, body, member.state, member.ride->carrier, !member.opposed), std::move(member.held));
  }
  const ContactChoice choice = restPathOf(motion_, body, member.state, pointersTo(member.held), !member.opposed, draft_.event.time);
  PathArc made = makePathArc(motion_, choice, draft_.event.time);
  goOn(participant, std::move(made.arc), std::move(made.held));
}

// In lasting contact, on an arc from the event on.
void Simulator::goOn(std::size_t participant, Arc arc, std::vector<Contact> held) {
  draft_.after[participant] = arc.startState();
  draft_.contact_state[participant].held = std::move(held);
  draft_.arcs.push_back(std::move(arc));
  in_draft_[index(bodies_[participant])] = static_cast<int>(participant);
  any_lasted_ = true;
}

// What stays goes on along its arc.
void Simulator::keep(std::size_t participant) {
  const int body = bodies_[participant];
  draft_.arcs.push_back(arcOf(body));
  in_draft_[index(body)] = static_cast<int>(participant);
}

// d^2/dt^2 of bodies that lie on each other, as after the event: none of those that do not.
std::optional<FreeAcceleration> Simulator::componentAcceleration(int body) const {
  if (const Participant* p = draft_.event.find(body); p && p->stays)
    return FreeAcceleration{arc_[index(body)]->rateAt(draft_.event.time, p->before).v, Vec3::Zero()};
  const auto joins = [&](const Contact& c) { return c.lasts && joinsMoved(c); };
  if (std::ranges::none_of(draft_.event.contacts, joins)) return std::nullopt;
  const std::vector<int> bodies = movedBodies(false);
  const std::vector<Contact> all = lasting(bodies);
  for (const std::vector<int>& touching : connectedBy(bodies, pointersTo(all))) {
    std::vector<Contact> closed;
    std::ranges::copy_if(all, std::back_inserter(closed), [&](const Contact& c) { return isOf(touching, c); });
    if (!has(touching, body) || std::ranges::none_of(closed, joins)) continue;
    if (const auto rest = restOf(touching, closed, 0)) {
      if (!rest->ride) return FreeAcceleration();
      return FreeAcceleration{rest->ride->carrier.at(draft_.event.time).accelerationAt(stateAfter(body).x), Vec3::Zero()};
    }
    const SupportedComponent component = componentOf(touching, closed);
    const auto at = std::ranges::find(component.members(), body, &Member::body) - component.members().begin();
    return component.pressedAccelerations()[static_cast<std::size_t>(at)];
  }
  return std::nullopt;
}

// What is placed with bodies on each other: the parts that are pressed together, with the contacts of each.
std::vector<std::pair<std::vector<int>, std::vector<Contact>>> Simulator::placedParts(const std::vector<PlacedContact>& placed) {
  std::vector<std::pair<std::vector<int>, std::vector<Contact>>> parts;
  const auto isBetween = [&](const PlacedContact& p) { return isMoved(p.a) && isMoved(p.b) && !overlapOf(p.a, p.b); };
  if (std::ranges::none_of(placed, isBetween)) return parts;
  beginDraft(0);
  std::vector<Contact> touching;
  std::vector<int> bodies;
  const double lowest = 2 * motion_.lowest_bounce * scene_.gravity.norm();
  const auto close = [&](const PlacedContact& p) {
    for (const FeaturePair& f : p.features) {
      Contact c = makeContact(0, p.a, p.b, f);
      if (c.approach * c.approach < lowest) touching.push_back(std::move(c));
    }
  };
  for (const PlacedContact& p : placed)
    if (isBetween(p)) close(p);
  for (const Contact& c : touching) bodies.push_back(c.a), bodies.push_back(c.b);
  std::ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  for (const PlacedContact& p : placed)
    if (isMoved(p.a) != isMoved(p.b) && has(bodies, isMoved(p.a) ? p.a : p.b) && !overlapOf(p.a, p.b)) close(p);
  for (const std::vector<int>& all : connectedBy(bodies, pointersTo(touching))) {
    const std::vector<Contact> closed = within(all, touching);
    std::vector<std::vector<int>> pressed = pressedParts(all, closed);
    std::erase_if(pressed, [](const std::vector<int>& part) { return part.size() == 1; });
    const auto rests = [&](const std::vector<int>& part) { return restOf(part, within(part, closed), 0).has_value(); };
    const bool whole = pressed.size() == 1 && pressed.front() == all;
    if (!whole && !std::ranges::all_of(pressed, rests)) pressed = {all};
    for (const std::vector<int>& part : pressed) parts.emplace_back(part, within(part, closed));
  }
  return parts;
}

}  // namespace carom::adjoint_detail
