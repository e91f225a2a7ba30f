// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Throws InputError unless a scene has as many bodies, materials and tilts as that of the motion that is followed.
void requireSameParts(const Scene& was, const Scene& scene);

/// The tiers of `like`, but for bodies whose moments have gained or lost a symmetry.
Plan planFor(const Motion& like, const Scene& scene, const std::vector<BodyModel>& models);

/// Puts events in the order of their times; whether that changes anything.
bool orderByTime(Motion& motion);

}  // namespace carom::adjoint_detail
