// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/contact/path_sensitivity.hpp"

namespace carom::adjoint_detail {

/// pathSensitivity in closed form: of a ball that rolls, and of one that slides on a level face, whose slip goes along a
/// line (11.18 of docs/equations.md). Nothing for any other path.
std::optional<PathSensitivity<double>> ballSensitivity(PathForm form, const PathInputs<double>& in, double elapsed,
                                                       bool orientation);

}  // namespace carom::adjoint_detail
