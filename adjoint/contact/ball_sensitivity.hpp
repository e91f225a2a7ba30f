// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/contact/contact_path.hpp"

namespace carom::adjoint_detail {

/// The matrix of pathSensitivity in closed form: of a ball that rolls, and of one that slides on a level face, whose slip goes along a
/// line (11.18 of docs/equations.md). Nothing for any other path.
std::optional<Eigen::Matrix<double, 12, 27>> ballSensitivity(PathForm form, const PathInputs<double>& in,
                                                             double elapsed, bool orientation);

}  // namespace carom::adjoint_detail
