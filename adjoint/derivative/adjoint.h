// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "adjoint/derivative/derivative_tape.h"

namespace carom {

/// Reverse pass: gradient of the seeded functional (the sum of the seeds) with respect to all scene parameters.
/// Visits only the events on which the seeds depend; the cost does not depend on the number of parameters. Equation
/// 5.3 of docs/equations.md. Throws InputError for an invalid body, event or instant and for weights that are not
/// finite, NotComputable if the derivative does not exist in doubles.
SceneGradient adjoint(const Motion& motion, std::span<const StateSeed> seeds, Reliability* reliability = nullptr);

/// The same for many rows of one motion, with shared linearisations.
SceneGradient adjoint(DerivativeTape& tape, std::span<const StateSeed> seeds, Reliability* reliability = nullptr);

}  // namespace carom
