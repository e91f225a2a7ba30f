// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "adjoint/contact/cone.hpp"

namespace carom::adjoint_detail {

/// Two contacts whose friction bears any push along the line between them: f != 0 in both cones, or on their border, that moves
/// nothing (K f = 0). At the border alone, as of a ball in a corner of 90 degrees with a coefficient of 1, the impulse that
/// least energy asks for has no bound. None: no two of them do.
std::optional<std::pair<int, int>> wedgedPair(const ConeProgramOf<double>& program);

}  // namespace carom::adjoint_detail
