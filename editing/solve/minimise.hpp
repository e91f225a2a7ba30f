// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// The smallest change near a point. Internal to editing/.
namespace carom::editing_detail {

/// Smallest change near `from` that meets `rows` (of those that hold a number; ranges count always), then all rows as
/// well as possible. With a signature, within that impact sequence. Returns the point where it ended; the search
/// remembers the best of all.
EditPointPtr minimiseChange(EditEvaluator& evaluator, const EditPointPtr& from, const std::vector<int>& rows,
                            const std::string* signature, int max_iterations);
/// The same within the impact sequence of a point that meets all rows.
EditPointPtr minimiseWithin(EditEvaluator& evaluator, const EditPointPtr& point, int max_iterations);
/// An objective of one's own made smaller from a point that meets all rows, within its impact sequence and those that
/// following it leads to.
EditPointPtr lowerObjective(EditEvaluator& evaluator, EditPointPtr point);
/// The same along the impact sequence of a point as if its features had no edges (adjoint/simulate/simulate_along.h).
/// Returns the point where that ended, with the motion that it really has, which may be of another sequence; or null.
EditPointPtr followSequence(EditEvaluator& evaluator, const EditPointPtr& from, const std::vector<int>& rows,
                            int max_iterations);

}  // namespace carom::editing_detail
