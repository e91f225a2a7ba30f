// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/strategy/edit_solution.hpp"

/// The last stage of solving an edit. Internal to editing/.
namespace carom::editing_detail {

/// Simulates the scene of a solution afresh, over the whole duration and with nothing left out, and reports what that
/// motion says: a solution that it does not confirm is not called solved. `written` is the scene before the edit.
EditResult verify(const Scene& written, const EditEvaluator& evaluator, const EditSolution& solution);
/// A solved edit that was cancelled `meanwhile` ("it looked for a smaller change") says so; its answer stays.
void endAsCancelled(const std::string& meanwhile, EditResult& result);

}  // namespace carom::editing_detail
