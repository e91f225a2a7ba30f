// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/base/work_count.h"
#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// How deep two solids overlap, m, along the direction that parts them soonest as far as that is known; nothing when
/// they do not overlap by more than `tolerance`. What is inside a closed mesh without touching it overlaps too. Steps are counted in `work`, if there is one.
std::optional<double> overlapOf(const Placed& a, const Placed& b, double tolerance,
                                WorkCount* work = nullptr);

}  // namespace carom::ode_bridge_detail
