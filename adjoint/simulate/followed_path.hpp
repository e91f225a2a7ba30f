// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/held/held_path.hpp"
#include "adjoint/simulate/path_arc.hpp"

namespace carom::adjoint_detail {

/// What a body in lasting contact is held by, where its path follows that of another motion.
struct FollowedPath {
  std::vector<Contact> contacts;
  PathTransition transition;
  const HeldPath* like = nullptr;  ///< of a path that contacts hold: that which it follows
  bool ends = false;               ///< `like` is followed to its end

  /// When the contact that the event `was` begins with comes to the border that it came to, in seconds from the start of
  /// the arc.
  std::optional<double> leaves(const Motion& motion, const Arc& arc, const Event& was) const {
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
};

/// Which guards end a path that follows another: all of them, that which ended the other, or none.
enum class HeldEnds { all, same, none };

/// Of a body that contacts hold, as `like` holds it. `contacts` are at least those of `like`, where they are now.
inline PathArc heldAlong(const Motion& motion, const HeldPath& like, HeldEnds ends, const State& start,
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

/// Takes an arc up to a time, or to where `like` ends. Any guard that falls to 0 before ends it at first; then it is made
/// anew without it: what is followed goes on there.
inline void extendAlong(const Motion& motion, const FollowedPath& held, Arc& arc, double time) {
  arc.extendTo(time);
  if (!arc.integrated() || !(arc.knownUntil() < time)) return;
  const auto& end = static_cast<const HeldPath&>(*arc.integrated()).end();
  if (!end || (held.ends && held.like->end() && end->guard.isSame(held.like->end()->guard))) return;
  arc = heldAlong(motion, *held.like, held.ends ? HeldEnds::same : HeldEnds::none, arc.startState(), held.contacts,
                  arc.start()).arc;
  arc.extendTo(time);
}

}  // namespace carom::adjoint_detail
