// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "editing/problem/edit_problem.hpp"
#include "editing/problem/margins/event_margins.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// Boundaries cost a reverse pass each, and an impact has several of them: a search looks at those of so many impacts.
inline constexpr std::size_t kBoundariesUpTo = 16;

/// The margins of a motion of the problem, with gradients with respect to the changes of its controls: of the first
/// `most_events` impacts, as far as they count for the constraints, and to the instants at which these read them. `tape` is
/// of a motion simulated at the unknowns, `rows` what the constraints read from it.
std::vector<EventMargin> sequenceBoundaries(const EditProblem& problem, const Eigen::VectorXd& unknowns,
                                            DerivativeTape& tape, const RowValues& rows, std::size_t most_events);

}  // namespace carom::editing_detail
