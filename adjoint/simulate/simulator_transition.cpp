// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/simulate/simulator.hpp"

// Paths in contact that come to their end.

namespace carom::adjoint_detail {

// The body of a path whose time has come goes on otherwise, from the state that it has.
void Simulator::resolveTransition(int body) {
  if (arcOf(body).trajectory().group()) return resolveGroupTransition(body);
  const BodyContactState from = contact_states_[index(body)];
  Event& event = draft_.event;
  beginDraft(from.transition);
  event.kind = EventKind::transition;
  snapshot(body, event.time);
  if (from.why.cause == TransitionCause::leaves && from.why.limit < 0) return resolveFlat(from, body);
  event.cause = from.why.cause;
  event.border = from.why.limit;
  const ConstrainedPath* path = arcOf(body).trajectory().constrained();
  draft_.past_end = path ? path->beyondEnd() : std::nullopt;
  if (event.cause == TransitionCause::leaves) {
    std::vector<Contact> beyond = contactsBeyond(from, body, event.time);
    std::erase_if(beyond, [&](const Contact& c) { return c.approach > strikingSpeed(c); });  // it parts from there
    if (std::ranges::any_of(beyond, [&](const Contact& c) { return strikes(c); })) return resolveLanding(beyond);
    addHeld(from.held[index(from.why.contact)], false);
    for (const Contact& c : beyond)
      if (!inDraft(c.a, c.b, c.features)) addHeld(c, true);
    dropDoubles(1);
  } else {
    const int first = from.why.contact;  // none of a body that slides without turning
    if (first >= 0) addHeld(from.held[index(first)], event.cause != TransitionCause::lifts);
    for (std::size_t k = 0; k < from.held.size(); ++k)
      if (static_cast<int>(k) != first) addHeld(from.held[k], true);
    if (arcOf(body).isIntegrated()) addBeside(from);
  }
  goOnOtherwise({body});
  predictDraft();
}

// A contact that held bodies up to a transition, as it is there, and whether it may go on.
Contact& Simulator::addHeld(const auto& h, bool lasts) {
  Contact& c = draft_.event.contacts.emplace_back(makeContact(draft_.event.time, h.a, h.b, h.features));
  c.counted = false;
  c.held = true;
  c.lasts = lasts;
  return c;
}
template Contact& Simulator::addHeld(const Contact& h, bool lasts);
template Contact& Simulator::addHeld(const GroupContact& h, bool lasts);

// The bodies of a transition go on from the states that they have, at its contacts.
void Simulator::goOnOtherwise(const std::vector<int>& bodies) {
  Event& event = draft_.event;
  bodies_ = bodies;
  event.participants.clear();
  draft_.after.clear();
  for (const int body : bodies) {
    const State& state = snapshots_[snapshot(body, event.time)].state;
    event.participants.push_back({body, static_cast<int>(motion_.world_lines[index(body)].arcs.size()) - 1, 0, state});
    draft_.after.push_back(state);
  }
  addCarriers();
  chooseArcs();
  std::erase_if(event.contacts, [](const Contact& c) { return !c.held && !c.lasts; });
}

// What touches beside the contacts that hold a body, as corners of a face that lies flat without pressing, may come to
// hold it. In a group a feature may be left on any of its bodies: what has just gone off one is no contact.
void Simulator::addBeside(const BodyContactState& from, bool of_group) {
  std::vector<Contact>& contacts = draft_.event.contacts;
  for (Contact& c : contactsAt(from, draft_.event.time, draft_.event.time, 0)) {
    if (inDraft(c.a, c.b, c.features) || c.approach > scaleOf(c.a, c.b, draft_.event.time).neither() || strikes(c) ||
        (of_group && isLeaving(c, true)))
      continue;
    c.counted = false;
    c.lasts = true;
    contacts.push_back(std::move(c));
  }
  dropDoubles(0, true);
}

// What a body rolls over to may come down on it instead: an impact like others.
void Simulator::resolveLanding(const std::vector<Contact>& on) {
  beginDraft(draft_.event.time);
  for (const Contact& c : on)
    if (strikes(c)) draft_.event.contacts.push_back(c);
  do {
    solveDraft();
    predictDraft();
  } while (joinInstant());
}

}  // namespace carom::adjoint_detail
