// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/numeric/union_find.hpp"
#include "adjoint/simulate/path_arc.hpp"
#include "adjoint/simulate/simulator.hpp"
#include "adjoint/simulate/supported_component.hpp"

// Bodies that lie on each other: components of those that contacts press together rest where all of them can
// (docs/equations.md, 11.14).

namespace carom::adjoint_detail {
namespace {

using Member = SupportedComponent::Member;

// The parts of `bodies` that these contacts connect, each in increasing order; those of one body alone are left out.
std::vector<std::vector<int>> connectedBy(const std::vector<int>& bodies, const std::vector<const Contact*>& contacts) {
  const auto placeOf = [&](int body) { return std::ranges::find(bodies, body) - bodies.begin(); };
  UnionFind sets(bodies.size());
  for (const Contact* c : contacts) {
    const auto a = placeOf(c->a), b = placeOf(c->b), none = static_cast<std::ptrdiff_t>(bodies.size());
    if (a < none && b < none) sets.join(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
  }
  std::vector<std::vector<int>> parts(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) parts[sets.find(i)].push_back(bodies[i]);
  std::erase_if(parts, [](const std::vector<int>& part) { return part.size() < 2; });
  for (std::vector<int>& part : parts) std::ranges::sort(part);
  std::ranges::sort(parts);
  return parts;
}

bool isOf(const std::vector<int>& bodies, const Contact& c) {
  const auto has = [&](int body) { return std::ranges::binary_search(bodies, body); };
  return has(c.a) || has(c.b);
}

}  // namespace

SupportedComponent Simulator::componentOf(const std::vector<int>& bodies, const std::vector<Contact>& closed) const {
  std::vector<Member> members;
  for (int body : bodies) members.push_back({body, stateAfter(body)});
  return {motion_, std::move(members), pointersTo(closed)};
}

// Of the event, those that last of bodies that impulses move, with what stands still.
std::vector<Contact> Simulator::closedOf(const std::vector<int>& bodies) const {
  std::vector<Contact> closed;
  for (const Contact& c : draft_.event.contacts) {
    if (!c.lasts || !isOf(bodies, c)) continue;
    const bool stands = (isMoved(c.a) || isFixed(c.a)) && (isMoved(c.b) || isFixed(c.b));
    if (!stands) continue;
    closed.push_back(c);
    closed.back().pair = builder_.pairOf(c.a, c.b);
  }
  dropFlatRims(closed);
  return closed;
}

// Participants that contacts which last connect, a part each.
std::vector<std::vector<int>> Simulator::touchingParts() const {
  std::vector<const Contact*> between;
  for (const Contact& c : draft_.event.contacts)
    if (c.lasts && isMoved(c.a) && isMoved(c.b)) between.push_back(&c);
  if (between.empty()) return {};  // far most often
  std::vector<int> moved;
  for (const Participant& p : draft_.event.participants)
    if (isMoved(p.body)) moved.push_back(p.body);
  return connectedBy(moved, between);
}

// Parts of these bodies that contacts press together.
std::vector<std::vector<int>> Simulator::pressedParts(const std::vector<int>& bodies, const std::vector<Contact>& closed) const {
  std::vector<const Contact*> pressing;
  for (const Contact* c : componentOf(bodies, closed).pressed())
    if (isMoved(c->a) && isMoved(c->b)) pressing.push_back(c);
  return connectedBy(bodies, pressing);
}

bool Simulator::standsStill(const SupportedComponent& component, bool opposed, double no_slip) const {
  for (std::size_t i = 0; i < component.members().size(); ++i) {
    const double reach = component.reachOf(i), least = leastSlip(scene_.gravity.norm(), reach);
    const double fastest = std::max(component.members()[i].state.v.norm(), reach * component.spinOf(i).norm());
    if (!(fastest <= least || (opposed && fastest <= no_slip))) return false;
  }
  return true;
}

// A component at rest: on what presses without friction if that is enough, else on all that is closed.
std::optional<Simulator::RestingComponent> Simulator::restOf(const std::vector<int>& bodies, const std::vector<Contact>& closed,
                                                              double no_slip) const {
  const SupportedComponent component = componentOf(bodies, closed);
  if (!standsStill(component, true, no_slip)) return std::nullopt;
  std::vector<const Contact*> on = component.pressed();
  SupportedComponent::Rest rest = component.restOn(on);
  if (!rest.holds && on.size() < closed.size()) {
    rest = component.restOn(pointersTo(closed));
    on = rest.bearing;
  }
  if (!rest.holds || !standsStill(component, rest.opposed, no_slip)) return std::nullopt;
  RestingComponent found{component.members(), {}, rest.opposed};
  for (const Contact* c : on) found.on.push_back(*c);
  return found;
}

// Members of components of the draft that rest, by participant: their states, and what holds them. Contacts that press bodies
// together which do not rest are kept in mind.
void Simulator::chooseComponents() {
  draft_.resting.assign(bodies_.size(), {});
  draft_.pressing.clear();
  for (const std::vector<int>& touching : touchingParts()) {
    const std::vector<Contact> all = closedOf(touching);
    for (const std::vector<int>& part : pressedParts(touching, all)) {
      const std::vector<Contact> closed = closedOf(part);
      std::optional<RestingComponent> rest = restOf(part, closed, hintOf(closed).no_slip);
      if (!rest) {
        for (const Contact* c : componentOf(part, closed).pressed())
          if (isMoved(c->a) && isMoved(c->b)) draft_.pressing.push_back(*c);
        continue;
      }
      if (std::ranges::any_of(rest->on, [](const Contact& c) { return !c.held; })) closeGaps(motion_, rest->members, rest->on);
      for (const Member& m : rest->members) {
        const auto participant = static_cast<std::size_t>(std::ranges::find(bodies_, m.body) - bodies_.begin());
        RestingMember& member = draft_.resting[participant].emplace(RestingMember{m.state, {}, rest->opposed});
        for (const Contact& c : rest->on)
          if (c.a == m.body || c.b == m.body) member.held.push_back(c);
      }
    }
  }
}

void Simulator::rest(std::size_t participant) {
  RestingMember& member = *draft_.resting[participant];
  const int body = bodies_[participant];
  ContactChoice choice = restPathOf(motion_, body, member.state, pointersTo(member.held), !member.opposed);
  PathArc made = makePathArc(motion_, choice, draft_.event.time);
  draft_.after[participant] = choice.start;
  draft_.contact_state[participant].held = std::move(made.held);
  draft_.arcs.push_back(std::move(made.arc));
  in_draft_[index(body)] = static_cast<int>(participant);
  any_lasted_ = true;
}

// d^2/dt^2 of bodies that lie on each other, as after the event: none of those that do not.
std::optional<FreeAcceleration> Simulator::componentAcceleration(int body) const {
  for (const std::vector<int>& touching : touchingParts()) {
    if (!std::ranges::binary_search(touching, body)) continue;
    const std::vector<Contact> closed = closedOf(touching);
    if (restOf(touching, closed, 0)) return FreeAcceleration();
    const SupportedComponent component = componentOf(touching, closed);
    const auto at = std::ranges::find(component.members(), body, &Member::body) - component.members().begin();
    return component.pressedAccelerations()[static_cast<std::size_t>(at)];
  }
  return std::nullopt;
}

// What is placed with bodies on each other: the parts that are pressed together, with the contacts of each.
std::vector<std::pair<std::vector<int>, std::vector<Contact>>> Simulator::placedParts(const std::vector<PlacedContact>& placed) {
  std::vector<std::pair<std::vector<int>, std::vector<Contact>>> parts;
  std::vector<const PlacedContact*> between;
  for (const PlacedContact& p : placed)
    if (isMoved(p.a) && isMoved(p.b) && !overlapOf(p.a, p.b)) between.push_back(&p);
  if (between.empty()) return parts;
  const double lowest = 2 * motion_.lowest_bounce * scene_.gravity.norm();
  const auto closedIn = [&](const PlacedContact& p, std::vector<Contact>& closed) {
    for (const FeaturePair& f : p.features) {
      Contact c = makeContact(0, p.a, p.b, f);
      if (!(c.approach * c.approach < lowest)) continue;
      c.counted = false;
      c.kept = c.lasts = true;
      closed.push_back(std::move(c));
    }
  };
  snapshots_.clear();
  draft_.event = {};
  std::vector<Contact> touching;
  for (const PlacedContact* p : between) closedIn(*p, touching);
  std::vector<int> bodies;
  for (const Contact& c : touching) bodies.push_back(c.a), bodies.push_back(c.b);
  std::ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  for (const PlacedContact& p : placed)
    if (isFixed(p.a) != isFixed(p.b) && std::ranges::binary_search(bodies, isFixed(p.a) ? p.b : p.a) && !overlapOf(p.a, p.b))
      closedIn(p, touching);
  for (const std::vector<int>& all : connectedBy(bodies, pointersTo(touching))) {
    std::vector<Contact> closed;
    std::ranges::copy_if(touching, std::back_inserter(closed), [&](const Contact& c) { return isOf(all, c); });
    for (const std::vector<int>& part : pressedParts(all, closed)) {
      std::vector<Contact> of_part;
      std::ranges::copy_if(closed, std::back_inserter(of_part), [&](const Contact& c) { return isOf(part, c); });
      parts.emplace_back(part, std::move(of_part));
    }
  }
  return parts;
}

}  // namespace carom::adjoint_detail
