// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/base/refuse.hpp"
#include "adjoint/group/group_modes.hpp"
#include "adjoint/group/group_start.hpp"
#include "adjoint/numeric/union_find.hpp"
#include "adjoint/simulate/contact_modes.hpp"
#include "adjoint/simulate/group_of.hpp"
#include "adjoint/simulate/simulator.hpp"

// Bodies that move on each other: groups, with one path each (docs/equations.md, 11.34).

namespace carom::adjoint_detail {
namespace {

// Larger groups take too long: their forces are solved as one (SimulateOptions::groups says so).
constexpr std::size_t kMostMembers = 8, kMostContacts = 36;
// Where a slip ends, all that are slower than this share of the unit of speed end with it.
constexpr double kStopTogether = 1e-6;
// So many changes in an instant, and one for each contact, never end: faces of one size that slide off each other lose each corner by itself.
constexpr std::size_t kMostChanges = 8;

}  // namespace

std::vector<State> Simulator::statesAfter(const std::vector<int>& bodies) const {
  std::vector<State> states;
  for (const int body : bodies) states.push_back(stateAfter(body));
  return states;
}

// How bodies that touch go on where they do not all rest: those that are held to each other as groups, others by themselves.
void Simulator::joinGroups(const std::vector<int>& touching, const std::vector<Contact>& closed) {
  const auto failed = [&](const std::string& why) {
    const auto joins = std::ranges::find_if(closed, [&](const Contact& c) { return joinsMoved(c); });
    for (const Contact& c : closed)
      if (joinsMoved(c)) draft_.pressing.push_back(c);
    endBeyond(*joins, why);
  };
  if (touching.size() > kMostMembers || closed.size() > kMostContacts)
    return failed(textOf(3, "they move on each other with ", touching.size(), " bodies and ", closed.size(), " contacts, more than ", kMostMembers, " or ",
                         kMostContacts));
  const std::vector<State> states = statesAfter(touching);
  const GroupScene scene = groupOf(motion_, touching, states, closed, draft_.event.time);
  std::vector<GroupContact> candidates;
  for (const Contact& c : closed) {
    GroupContact& of = candidates.emplace_back();
    of.a = c.a, of.b = c.b, of.features = c.features, of.friction = c.pair.friction;
    of.member_a = placeIn(touching, c.a), of.member_b = placeIn(touching, c.b);
  }
  GroupHint hint;
  hint.no_slip = std::max(hintOf(closed).no_slip, leastSlip(scene_.gravity.norm(), scene.length));
  if (draft_.event.kind == EventKind::transition) {
    if (draft_.event.cause == TransitionCause::sticks) hint.no_slip = std::max(hint.no_slip, kStopTogether * scene.speed);
    if (draft_.group_beyond && draft_.group_beyond->bodies == touching) hint.beyond = {draft_.group_beyond->states, draft_.group_beyond->time};
  }
  GroupModes modes;
  try {
    modes = chooseGroupModes(scene, candidates, states, scene.time, hint);
  } catch (const NotComputable& error) {
    modes.unresolved = error.what();
  }
  if (!modes.unresolved.empty()) return failed(modes.unresolved);
  UnionFind sets(touching.size());
  for (const GroupContact& c : modes.contacts)
    if (c.member_a >= 0 && c.member_b >= 0) sets.join(static_cast<std::size_t>(c.member_a), static_cast<std::size_t>(c.member_b));
  for (std::size_t root = 0; root < touching.size(); ++root) {
    std::vector<int> members;
    for (std::size_t i = 0; i < touching.size(); ++i)
      if (sets.find(i) == root) members.push_back(touching[i]);
    if (members.size() > 1) beginGroup(members, closed, modes);
  }
}

void Simulator::beginGroup(const std::vector<int>& members, const std::vector<Contact>& closed, const GroupModes& modes) {
  std::vector<Contact> own;
  std::vector<GroupContact> contacts;
  for (std::size_t i = 0; i < modes.held.size(); ++i) {
    const Contact& c = closed[modes.held[i]];
    if (placeIn(members, c.a) < 0 && placeIn(members, c.b) < 0) continue;
    own.push_back(c);
    contacts.push_back(modes.contacts[i]);
    contacts.back().member_a = placeIn(members, c.a), contacts.back().member_b = placeIn(members, c.b);
  }
  std::vector<State> states = statesAfter(members);
  GroupScene scene = groupOf(motion_, members, states, own, draft_.event.time);
  work_.step(kConstrainedStep * std::max<std::size_t>(1, own.size() * own.size() / 4));
  std::shared_ptr<GroupPath> path;
  try {
    std::vector<State> start = groupStart(scene, contacts, std::move(states), scene.time);
    path = std::make_shared<GroupPath>(std::move(scene), std::move(contacts), modes.redundant, std::move(start), motion_.duration);
  } catch (const NotComputable& error) {
    giveUp("contact", own.front().a, own.front().b, draft_.event.time, error);
  }
  const std::size_t most = kMostChanges + own.size();
  for (std::size_t slot = 0; slot < members.size(); ++slot) {
    GroupMembership& of = draft_.grouped[participantIn(members[slot])].emplace();
    of.path = path, of.slot = static_cast<int>(slot);
    std::ranges::copy_if(own, std::back_inserter(of.held), [&](const Contact& c) { return c.a == members[slot] || c.b == members[slot]; });
    if (changesTooOften(members[slot], most)) endBeyond(of.held.front(), textOf(3, "their contact modes change more than ", most, " times in one instant"));
  }
}

void Simulator::followGroup(std::size_t participant) {
  GroupMembership& of = *draft_.grouped[participant];
  const int body = bodies_[participant];
  const State& start = of.path->startStates()[static_cast<std::size_t>(of.slot)];
  Arc arc(motion_.modelOf(body), motion_.plan.bodies[index(body)].tier, of.path, draft_.event.time, start, of.slot);
  BodyContactState& state = draft_.contact_state[participant];
  state.steps = arc.series();
  if (of.path->ending()) state.transition = of.path->knownUntil();
  goOn(participant, std::move(arc), std::move(of.held));
}

// What one member has extended is known to all of them.
void Simulator::refreshGroup(int body) {
  const GroupPath* path = arcOf(body).trajectory().group();
  if (!path || contact_states_[index(body)].steps == path->series()) return;
  for (const GroupMember& member : path->scene().members) {
    Arc& arc = arcOf(member.body);
    if (arc.trajectory().group() != path) continue;
    arc.extendTo(arc.start());  // its bounds
    BodyContactState& state = contact_states_[index(member.body)];
    state.steps = path->series();
    if (path->ending()) state.transition = path->knownUntil();
    setPath(member.body, arc, std::max(arc.start(), now_));
  }
}

// The path of a group whose time has come: all of its bodies go on otherwise, from the states that they have.
void Simulator::resolveGroupTransition(int body) {
  const std::shared_ptr<Trajectory> keeps = arcOf(body).shared();
  const GroupPath& path = *keeps->group();
  Event& event = draft_.event;
  const TrajectoryEnd end = path.end();
  beginDraft(end.time);
  event.kind = EventKind::transition;
  event.cause = end.cause;
  event.border = end.limit;
  std::vector<int> members;
  for (const GroupMember& m : path.scene().members) members.push_back(m.body);
  const GroupContact& first = path.contacts()[index(end.contact)];
  if (event.cause == TransitionCause::leaves) {
    const int of = isMoved(first.a) ? first.a : first.b;
    std::vector<Contact> beyond = contactsAside(makeContact(event.time, first.a, first.b, first.features), end.limit);
    if (beyond.empty()) beyond = contactsBeyond(contact_states_[index(of)], of, event.time);
    std::erase_if(beyond, [&](const Contact& c) { return c.approach > strikingSpeed(c) || c.a != first.a || c.b != first.b; });
    if (std::ranges::any_of(beyond, [&](const Contact& c) { return strikes(c); })) return resolveLanding(beyond);
    addHeld(first, false);
    for (const Contact& c : beyond)
      if (!inDraft(c.a, c.b, c.features)) {
        const bool known = std::ranges::any_of(path.contacts(), [&](const GroupContact& h) { return h.a == c.a && h.b == c.b && h.features == c.features; });
        addHeld(c, true).held = known;
      }
  } else {
    addHeld(first, event.cause != TransitionCause::lifts);
  }
  // of a pair that leaves a feature all that it has is known, others of its contacts may leave with the first
  const auto known = [&](int a, int b) { return event.cause == TransitionCause::leaves && a == first.a && b == first.b; };
  for (const GroupContact& h : path.contacts())
    if (!known(h.a, h.b) && !inDraft(h.a, h.b, h.features)) addHeld(h, true);
  for (const int member : members) addBeside(contact_states_[index(member)], true);
  draft_.group_beyond.reset();
  if (auto later = path.beyondEnd()) draft_.group_beyond = {members, std::move(later->first), later->second};
  goOnOtherwise(members);
  predictDraft();
}

}  // namespace carom::adjoint_detail
