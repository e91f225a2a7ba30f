// SPDX-License-Identifier: MIT
#include "adjoint/simulate/followed_path.hpp"

#include <algorithm>

#include "adjoint/base/errors.h"
#include "adjoint/group/group_path.hpp"

namespace carom::adjoint_detail {
namespace {

// Which guards end a path that follows another: all of them, that which ended the other, or none.
enum class ConstrainedEnds { all, same, none };

// Of a body that contacts hold, as `like` holds it. `contacts` are at least those of `like`, where they are now.
PathArc constrainedAlong(const Motion& motion, const ConstrainedPath& like, ConstrainedEnds ends, const State& start,
                         const std::vector<Contact>& contacts, double time) {
  std::vector<const Contact*> held;
  const int body = like.scene().body;
  for (const PersistentContact& c : like.contacts()) {
    const auto found = std::ranges::find_if(contacts, [&](const Contact& now) {
      return now.features == c.features && (c.is_first ? now.a : now.b) == body && (c.is_first ? now.b : now.a) == c.with;
    });
    if (found == contacts.end()) throw NotComputable("a persistent contact is missing");
    held.push_back(&*found);
  }
  const ContactChoice choice = constrainedPathOf(motion, body, start, held, like.contacts(), time);
  if (!choice.path) throw NotComputable(choice.beyond);
  std::vector<ConstrainedGuard> guards;
  for (ConstrainedGuard& guard : guardsOf(choice.scene, choice.modes.contacts, choice.start, time)) {
    const bool is_same = like.ending() && guard.isSame(like.ending()->guard);
    if (ends == ConstrainedEnds::all || (ends == ConstrainedEnds::same && is_same)) guards.push_back(std::move(guard));
  }
  return makeConstrainedArc(motion, choice, time, std::move(guards));
}

}  // namespace

std::optional<double> FollowedPath::leaves(const Motion& motion, const Arc& arc, const Event& was) const {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!(contacts[k].features == was.contacts[0].features)) continue;
    const auto contact = static_cast<int>(k);
    if (transition.cause == was.cause && transition.contact == contact && transition.limit == was.border)
      return transition.elapsed;
    const ContactChoice choice =
        contactPathOf(motion, arc.closedForm()->body, arc.startState(), pointersTo(contacts), arc.closedForm()->form, arc.start());
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
  const std::size_t next = asIndex(p.next());
  const ConstrainedPath& path = *line.arcs[next].trajectory().constrained();
  PathArc made = constrainedAlong(motion, path, ConstrainedEnds::all, after, from, time);
  contacts = std::move(made.held), transition = made.transition, like = &path;
  ends = endsByItself(was, p);
  return std::move(made.arc);
}

bool endsByItself(const Motion& motion, const Participant& p) {
  const std::vector<int>& events = motion.world_lines[asIndex(p.body)].events;
  const std::size_t next = asIndex(p.next());
  return next < events.size() && motion.events[asIndex(events[next])].kind == EventKind::transition;
}

void extendAlong(const Motion& motion, const FollowedPath& held, Arc& arc, double time) {
  arc.extendTo(time);
  const ConstrainedPath* path = arc.trajectory().constrained();
  if (!path || !(arc.knownUntil() < time)) return;
  const auto& end = path->ending();
  if (!end || (held.ends && held.like->ending() && end->guard.isSame(held.like->ending()->guard))) return;
  arc = constrainedAlong(motion, *held.like, held.ends ? ConstrainedEnds::same : ConstrainedEnds::none, arc.startState(), held.contacts,
                  arc.start()).arc;
  arc.extendTo(time);
}

void extendGroup(Motion& motion, const FollowedPath& held, int body, double time) {
  Arc& arc = motion.world_lines[asIndex(body)].arcs.back();
  const GroupPath* path = arc.trajectory().group();
  if (!path) return;
  arc.extendTo(time);
  if (!(arc.knownUntil() < time) || !path->ending()) return;
  const auto same = [&](const ConstrainedGuard& guard) {
    return held.ends && held.group->ending() && guard.isSame(held.group->ending()->guard);
  };
  if (same(path->ending()->guard)) return;
  const std::shared_ptr<GroupPath> on = path->endedBy(same);
  for (const SharedLinearization::Member& member : path->membersIn(motion)) {
    Arc& of = motion.world_lines[asIndex(member.body)].arcs[asIndex(member.arc)];
    of = of.on(on);
    of.extendTo(time);
  }
}

bool landsFlat(const Motion& motion, const Event& event) {
  return std::ranges::any_of(event.participants, [&](const Participant& p) {
    const std::vector<Arc>& arcs = motion.world_lines[asIndex(p.body)].arcs;
    const auto path = [&](int arc) { return arcs[asIndex(arc)].trajectory().constrained(); };
    const ConstrainedPath *before = path(p.arc), *after = path(p.next());
    return (before && before->endsFlat() && before->knownUntil() == event.time) || (after && after->beginsFlat());
  });
}

}  // namespace carom::adjoint_detail
