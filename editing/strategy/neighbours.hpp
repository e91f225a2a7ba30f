// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/solve/edit_evaluator.hpp"

/// Internal to editing/.
namespace carom::editing_detail {

/// Unknowns a little beyond the boundaries of the impact sequence of a differentiated point x, at which its impacts become
/// others or bodies meet that nearly do, two for each boundary with the unit gradient g: the nearest, x - d g; and that
/// where the rows, as they are linear around x, are met and the change is the smallest, z - s N N^T g, with z the
/// smallest change that meets them and N an orthonormal basis of the directions that change none. Left out are changes
/// longer than `below`: to first order there is no smaller one beyond. The smallest change first. Of bodies that nearly
/// meet `near_misses` pairs at most.
std::vector<Eigen::VectorXd> beyondBoundaries(const EditEvaluator& evaluator, const EditPoint& point, double below,
                                              std::size_t near_misses);

}  // namespace carom::editing_detail
