// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_path.hpp"
#include "adjoint/simulate/path_arc.hpp"

namespace carom::adjoint_detail {

/// What a body in lasting contact is held by, where its path follows that of another motion.
struct FollowedPath {
  std::vector<Contact> contacts;
  PathTransition transition;
  const ConstrainedPath* like = nullptr;  ///< of a path that contacts hold: that which it follows
  bool ends = false;               ///< `like` is followed to its end
  const GroupPath* group = nullptr;  ///< the same of one of several bodies

  /// When the contact that the event `was` begins with comes to the border that it came to, in seconds from the start of
  /// the arc.
  std::optional<double> leaves(const Motion& motion, const Arc& arc, const Event& was) const;

  /// The body's contacts of an event, and those that held it before.
  std::vector<Contact> contactsAt(const Event& event, int body) const;
  /// The arc of a body that contacts hold after an event, as they did in `was` after it; from then on this is about it.
  Arc follow(const Motion& motion, const Motion& was, const Participant& p, const State& after,
             const std::vector<Contact>& from, double time);
};

/// Whether the arc on which a participant goes on after an event ends by itself, not by an impact.
bool endsByItself(const Motion& motion, const Participant& p);

/// Takes an arc up to a time, or to where `like` ends. Any guard that falls to 0 before ends it at first; then it is made
/// anew without it: what is followed goes on there.
void extendAlong(const Motion& motion, const FollowedPath& held, Arc& arc, double time);

/// The same of a body that moves on others: of all arcs that share its trajectory.
void extendGroup(Motion& motion, const FollowedPath& held, int body, double time);

/// Whether a rim that holds a body comes to lie flat at an event, or tilts from there on: the lowest point of it there is that
/// of this motion, and of none beside it.
bool landsFlat(const Motion& motion, const Event& event);

}  // namespace carom::adjoint_detail
