// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/problem/rows/constraint_rows.hpp"

namespace carom::editing_detail {

/// For each constraint between two times the instant within its span at which it is missed least, to rounding: a time, or
/// an event of its bodies, where the miss has a kink.
std::vector<Instant> nearestInstants(const ConstraintSet& constraints, const Motion& motion);

/// Whether such an instant moves along the motion as that changes: it is neither an event nor an end of the span.
bool movesInSpan(const FreeTime& span, const Motion& motion, const Instant& instant);

}  // namespace carom::editing_detail
