// SPDX-License-Identifier: MIT
#pragma once

#include "editing/strategy/edit_solution.hpp"
#include "editing/why_not.h"

/// Internal to editing/.
namespace carom::editing_detail {

/// Why a search ended without meeting all constraints. Solves the edit anew with each of the kTries most helpful
/// controls added, in at most kTryIterations steps within the initial impact sequence.
WhyNot explain(const Scene& written, EditEvaluator& evaluator, const EditSolution& solution);
/// The same into a result that is infeasible or did not converge, whose message then also says what would solve it. A
/// nail inside a body makes the edit infeasible, however the search ended.
void explainInto(EditResult& result, const Scene& written, EditEvaluator& evaluator, const EditSolution& solution);
inline constexpr int kTries = 3, kTryIterations = 60;

}  // namespace carom::editing_detail
