// SPDX-License-Identifier: MIT
#pragma once

#include "editing/strategy/edit_solution.hpp"

/// Several solutions of one edit. Internal to editing/.
namespace carom::editing_detail {

/// The solutions that a search met besides its best, each simulated again, as many as the options ask for; what is
/// not confirmed is left out.
std::vector<EditAlternative> alternativesTo(const Scene& written, const EditEvaluator& evaluator,
                                            const EditSolution& solution);

}  // namespace carom::editing_detail
