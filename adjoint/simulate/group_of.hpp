// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/group/group_path.hpp"

namespace carom::adjoint_detail {

/// Bodies that move on each other from a time on, from these states, at these contacts with each other and with what impulses do not move.
GroupScene groupOf(const Motion& motion, const std::vector<int>& members, const std::vector<State>& states, const std::vector<Contact>& closed,
                   double time);

/// The group that a participant of an event of a motion belongs to from there on; null: none.
const GroupPath* groupAfter(const Motion& motion, const Participant& p);

/// Arcs of the participants of the event `was` of `like` that move on each other from there, where a motion that follows it has the states
/// `after` at a time: in the same modes. Throws NotComputable where there are none.
std::vector<std::optional<Arc>> groupsAlong(const Motion& like, const Event& was, const Motion& motion, const std::vector<State>& after, double time);

}  // namespace carom::adjoint_detail
