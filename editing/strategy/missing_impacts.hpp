// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// Impacts that a motion lacks. Internal to editing/.
namespace carom::editing_detail {

/// The impacts that a point waits for and lacks. Where there are none, those without which nothing that varies has a
/// part in a constraint that is not met: its body would have to be struck, by one of the bodies that the controls move.
std::vector<LackingImpact> missingImpacts(const EditProblem& problem, const EditPoint& point);

/// Whether there are any.
inline bool lacksImpacts(const EditProblem& problem, const EditPoint& point) { return !missingImpacts(problem, point).empty(); }

}  // namespace carom::editing_detail
