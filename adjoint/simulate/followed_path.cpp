// SPDX-License-Identifier: MIT
#include "adjoint/simulate/followed_path.hpp"

#include <algorithm>

#include "adjoint/base/errors.h"

namespace carom::adjoint_detail {
namespace {

// Which guards end a path that follows another: all of them, that which ended the other, or none.
enum class HeldEnds { all, same, none };

// Of a body that contacts hold, as `like` holds it. `contacts` are at least those of `like`, where they are now.
PathArc heldAlong(const Motion& motion, const HeldPath& like, HeldEnds ends, const State& start,
                         const std::vector<Contact>& contacts, double time) {
  std::vector<const Contact*> held;
  const int body = like.scene().body;
  for (const HeldContact& c : like.contacts()) {
    const auto found = std::ranges::find_if(contacts, [&](const Contact& now) {
      return now.features == c.features && (c.is_first ? now.a : now.b) == body && (c.is_first ? now.b : now.a) == c.with;
    });
    if (found == contacts.end()) throw NotComputable("a contact that lasts is missing");
    held.push_back(&*found);
  }
  const ContactChoice choice = heldPathOf(motion, body, start, held, like.contacts());
  if (!choice.path) throw NotComputable(choice.beyond);
  std::vector<HeldGuard> guards;
  for (HeldGuard& guard : guardsOf(choice.scene, choice.modes.contacts, choice.start)) {
    const bool is_same = like.end() && guard.isSame(like.end()->guard);
    if (ends == HeldEnds::all || (ends == HeldEnds::same && is_same)) guards.push_back(std::move(guard));
  }
  return makeHeldArc(motion, choice, time, std::move(guards));
}

}  // namespace

std::optional<double> FollowedPath::leaves(const Motion& motion, const Arc& arc, const Event& was) const {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!(contacts[k].features == was.contacts[0].features)) continue;
    const auto contact = static_cast<int>(k);
    if (transition.cause == was.cause && transition.contact == contact && transition.limit == was.border)
      return transition.elapsed;
    const ContactChoice choice =
        contactPathOf(motion, arc.path()->body, arc.startState(), pointersTo(contacts), arc.path()->form);
    return whenContactLeaves(motion, choice, contact, was.border, motion.duration - arc.start());
  }
  return std::nullopt;
}

std::vector<Contact> FollowedPath::contactsAt(const Event& event, int body) const {
  std::vector<Contact> found;
  for (const std::vector<Contact>* of : {&event.contacts, &contacts})
    for (const Contact& c : *of)
      if (c.a == body || c.b == body) found.push_back(c);
  return found;
}

Arc FollowedPath::follow(const Motion& motion, const Motion& was, const Participant& p, const State& after,
                         const std::vector<Contact>& from, double time) {
  const WorldLine& line = was.world_lines[asIndex(p.body)];
  const std::size_t next = asIndex(p.arc) + 1;
  const auto& path = static_cast<const HeldPath&>(*line.arcs[next].integrated());
  PathArc made = heldAlong(motion, path, HeldEnds::all, after, from, time);
  contacts = std::move(made.held), transition = made.transition, like = &path;
  ends = next < line.events.size() && was.events[asIndex(line.events[next])].kind == EventKind::transition;
  return std::move(made.arc);
}

void extendAlong(const Motion& motion, const FollowedPath& held, Arc& arc, double time) {
  arc.extendTo(time);
  if (!arc.integrated() || !(arc.knownUntil() < time)) return;
  const auto& end = static_cast<const HeldPath&>(*arc.integrated()).end();
  if (!end || (held.ends && held.like->end() && end->guard.isSame(held.like->end()->guard))) return;
  arc = heldAlong(motion, *held.like, held.ends ? HeldEnds::same : HeldEnds::none, arc.startState(), held.contacts,
                  arc.start()).arc;
  arc.extendTo(time);
}

bool landsFlat(const Motion& motion, const Event& event) {
  return std::ranges::any_of(event.participants, [&](const Participant& p) {
    const std::vector<Arc>& arcs = motion.world_lines[asIndex(p.body)].arcs;
    const auto path = [&](int arc) { return static_cast<const HeldPath*>(arcs[asIndex(arc)].integrated()); };
    const HeldPath *before = path(p.arc), *after = path(p.arc + 1);
    return (before && before->endsFlat() && before->knownUntil() == event.time) || (after && after->beginsFlat());
  });
}

}  // namespace carom::adjoint_detail
