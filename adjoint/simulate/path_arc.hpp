// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_guards.hpp"
#include "adjoint/constrained/ride_path.hpp"
#include "adjoint/simulate/path_transition.hpp"

namespace carom::adjoint_detail {

/// An arc in lasting contact, what it is held by, and when it goes on otherwise.
struct PathArc {
  Arc arc;
  std::vector<Contact> held;
  PathTransition transition;  ///< up to the duration of the motion
};
PathArc makePathArc(const Motion& motion, const ContactChoice& choice, double time);
/// The same of contacts that hold it, up to the first of these guards.
PathArc makeConstrainedArc(const Motion& motion, const ContactChoice& choice, double time, std::vector<ConstrainedGuard> guards);
/// Rest on a carrier, from its start on, in the pose of a state.
Arc rideArc(const Motion& motion, int body, const State& state, const Carrier& carrier, bool loose);
/// How an integrated path goes on, as far as that is known.
PathTransition constrainedTransition(const Arc& arc, double start);

/// The pose with all gaps 0, moved as little as possible as measured by the mass (11.13); the contacts follow.
void closeGaps(const Motion& motion, int body, State& state, std::vector<Contact>& closed);

}  // namespace carom::adjoint_detail
