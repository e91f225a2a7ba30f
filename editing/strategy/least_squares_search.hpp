// SPDX-License-Identifier: MIT
#pragma once

#include "editing/solve/edit_evaluator.hpp"

/// Least squares of soft constraints, across impact sequences. Internal to editing/.
namespace carom::editing_detail {

/// From a point that meets the hard constraints, at once and by ever longer parts of a recording, and from the best of samples around it that are brought onto them: the
/// smallest objective that steps of least squares come to. With Effort::fast from the point alone.
EditPointPtr smallestSquares(EditEvaluator& evaluator, const EditPointPtr& from);

}  // namespace carom::editing_detail
