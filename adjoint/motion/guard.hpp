// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// The guard of an event is the mean gap of its contacts, weighted by their normal impulses: one weight a contact.
std::vector<double> guardWeights(const Event& event);

/// Index of the participant that a body is; -1 where it takes no part.
int participantOf(const Event& event, int body);

/// Pose of the shape of a body in a state.
Pose shapePose(const Motion& motion, int body, const State& state);

/// The same just before an event; of a body that takes no part in it, at the start.
Pose poseBefore(const Motion& motion, const Event& event, int body);

}  // namespace carom::adjoint_detail
