// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "adjoint/base/work_count.h"
#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// The first time in [from, until] at which two solids do not overlap; none where they overlap all the time. What parts
/// them by less than 1e-4 of their size before they overlap again may be passed over. Extends the arcs. Throws
/// NotComputable where they take too many steps to follow. Steps are counted in `work`, if there is one.
std::optional<double> partingTime(const Solid& a, const Solid& b, Arc& arc_a, Arc& arc_b, double from, double until,
                                  WorkCount* work = nullptr);

}  // namespace carom::ode_bridge_detail
