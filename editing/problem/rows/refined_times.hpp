// SPDX-License-Identifier: MIT
#pragma once

#include "editing/problem/rows/constraint_rows.hpp"

namespace carom::editing_detail {

/// For each free time the one at which its constraint is most nearly met in a motion: ConstraintSet::nearestTimes,
/// followed to the bottom by golden sections. Where the constraint is met, to rounding.
Eigen::VectorXd refinedTimes(const ConstraintSet& constraints, const Motion& motion);

}  // namespace carom::editing_detail
