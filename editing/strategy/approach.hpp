// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/solve/edit_evaluator.hpp"

/// Towards impacts that a motion lacks. Internal to editing/.
namespace carom::editing_detail {

/// How much a point lacks of missingImpacts: of each, the share of what was required that did not come, and d / (d + L) of
/// the least distance d at which the bodies that should meet next pass, of length L. 0: it lacks none.
double lackOf(const EditProblem& problem, const EditPoint& point);

enum class Aim {
  well_into,  ///< the other body, so that what arrives does not graze
  just_into   ///< it, back over the boundary at which the impact was missed
};

/// Steps that make the least distance smaller at which the bodies of the first such impact pass. Returns a point that
/// lacks no impact, or the one that lacks least.
EditPointPtr approach(EditEvaluator& evaluator, EditPointPtr point, int max_steps, Aim aim = Aim::well_into);

/// "The nearest that 'cue' and 'yellow' came was 0.12 m, at 0.8 s." Empty where nothing is known of distances.
std::string describeApproach(const EditProblem& problem, const EditPoint& point);

}  // namespace carom::editing_detail
