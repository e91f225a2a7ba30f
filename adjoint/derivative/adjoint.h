// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "adjoint/derivative/derivative_tape.h"

namespace carom {

/// Reverse pass: the gradient, by every number of the scene, of the sum of the seeds. Walks only the events that the
/// seeds depend on; its cost does not depend on the number of controls. Equations 5.3 of docs/equations.md.
/// Throws InputError for a body, an event or an instant that the motion does not have and for weights that are not
/// finite, NotComputable where the motion can be computed with but its derivative cannot.
SceneGradient adjoint(const Motion& motion, std::span<const StateSeed> seeds, Reliability* reliability = nullptr);

/// The same for many rows of one motion: linearisations are shared.
SceneGradient adjoint(DerivativeTape& tape, std::span<const StateSeed> seeds, Reliability* reliability = nullptr);

}  // namespace carom
