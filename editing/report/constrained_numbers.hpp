// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/edit_result.h"
#include "editing/problem/rows/constraint_rows.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// All rows as they are in a motion.
std::vector<ConstrainedNumber> constrainedNumbers(const ConstraintSet& constraints, const RowValues& rows);

}  // namespace carom::editing_detail
