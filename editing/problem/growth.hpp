// SPDX-License-Identifier: MIT
#pragma once

#include "editing/problem/edit_problem.hpp"

/// How sensitive a motion is. Internal to editing/.
namespace carom::editing_detail {

/// How much further the numbers that are held move with a small change of the state of the moving bodies at the start
/// than they would if the bodies had flown freely for as long; of the row with the most. States and rows are in
/// natural scales, so it is a number: 1 for a free flight and, near enough, for a ball among flat walls; it grows by a
/// factor with every impact on an edge, a corner or another round body.
///   growth = max_i |ds_0 row_i| / |ds row_i|(T),  |s|(T)^2 = |x|^2 + |theta|^2 + |(v, w)|^2 with x and theta times
///   sqrt(1 + (T/time scale)^2), the farthest that free flight carries a change of velocity in time T.
double growthOf(const Motion& motion, const EditProblem& problem, const RowValues& rows);

}  // namespace carom::editing_detail
