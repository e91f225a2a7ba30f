// SPDX-License-Identifier: MIT
#pragma once

#include "editing/edit_result.h"
#include "editing/solve/edit_evaluator.hpp"

/// What a fit of soft constraints tells of the parameters. Internal to editing/.
namespace carom::editing_detail {

/// Fills in EditResult::fit, soft_residuals, and the standard deviations of the changed numbers, from the motion of the
/// result. Nothing without soft constraints.
void fitInto(EditResult& result, const EditEvaluator& evaluator, const EditPointPtr& point);

}  // namespace carom::editing_detail
